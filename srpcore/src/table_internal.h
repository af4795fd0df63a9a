/* SPDX-License-Identifier: Apache-2.0 */
/* What the inside of a table looks like to the file formats. Internal. */
#ifndef SRP_SRC_TABLE_INTERNAL_H
#define SRP_SRC_TABLE_INTERNAL_H

#include <srp/table.h>

#include <stdbool.h>
#include <stddef.h>

/* Largest grid: steps of 0.01 degrees. */
enum { SRP_GRID_AZ_MAX = 36001, SRP_GRID_EL_MAX = 18001 };

struct srp_table {
    srp_grid grid;
    srp_table_info info; /* strings set by srp_table_set_text() */
    bool has_lattice;    /* info.params.lattice, seed and tolerance decide the numbers */
    size_t material_count;
    char **material_names;
    srp_optics *material_optics;
    /* (az_count, el_count), elevation fastest. Responses of empty nodes are zero. */
    srp_response *nodes;
    srp_basis *basis; /* (az_count, el_count, material_count + 1), NULL when not kept */
    unsigned char *filled;
    size_t filled_count;
    /* Where the text that it was read from says a |f| of its own, the farthest of them from that of
     * the components [m^2]; line 0: nowhere. */
    struct {
        size_t line;
        double said, off;
    } total;
};

/* Index of node (i, j) in nodes and filled. */
static inline size_t srp_table_index(const srp_table *table, uint32_t i, uint32_t j) {
    return (size_t)i * table->grid.el_count + j;
}

/* The node that stands for all that share the direction of node (i, j): at the lowest azimuth. */
static inline size_t srp_table_first_index(const srp_table *table, uint32_t i, uint32_t j) {
    const srp_grid grid = table->grid;
    const bool pole = j == 0 || j == grid.el_count - 1;
    return srp_table_index(table, pole || i == grid.az_count - 1 ? 0 : i, j);
}

/* Nodes of different directions. */
size_t srp_table_unique_count(srp_grid grid);
/* Fills a node; `basis` is its row of sums, NULL in tables without. */
void srp_table_put_node(srp_table *table, size_t index, const srp_response *response,
                        const srp_basis *basis);
/* Copies a node, the first of its direction, to the empty ones that share the direction. */
void srp_table_share_node(srp_table *table, size_t index);

/* Copies to `to` the nodes that it lacks and `from`, a table of the same origin, has; returns how
 * many directions that is. */
size_t srp_table_take(srp_table *to, const srp_table *from);

/* An empty table that says nothing of its origin; the names of its materials are NULL until they
 * are set by srp_table_set_material(). SRP_BAD_ARGUMENT (grid), SRP_NO_MEMORY. */
srp_status srp_table_create_blank(srp_grid grid, size_t material_count, bool with_basis,
                                  srp_table **out, srp_error *error);

/* Sets a string of table->info, e.g. &table->info.title, to a copy of `size` bytes of `text`.
 * SRP_NO_MEMORY. */
srp_status srp_table_set_text(const char **slot, const char *text, size_t size, srp_error *error);
srp_status srp_table_set_material(srp_table *table, size_t index, const char *name, size_t size,
                                  srp_optics optics, srp_error *error);

/* SRP_BAD_ARGUMENT unless flux, au and mass are within SRP_SCALE_MIN and SRP_SCALE_MAX; the mass
 * may be NAN (not given). */
srp_status srp_table_check_light(srp_sunlight light, double mass, srp_error *error);

/* Marks a node, whose response is in place, as there. */
void srp_table_mark_filled(srp_table *table, size_t index);

/* Checksum (XXH3, 128 bits, 32 hexadecimal digits) of everything that a table holds, independent of
 * how and where it is stored. */
void srp_table_checksum(const srp_table *table, char out[33]);
/* Checksum of what decides the numbers of a table, whichever of them are there: format, library
 * version, grid, method, device, shape, optics, parameters and whether sums are kept. Tables that
 * srp_table_check_origin() takes for one another have the same. */
void srp_table_key(const srp_table *table, char out[33]);
/* The same of bytes. */
void srp_bytes_checksum(const void *bytes, size_t size, char out[33]);

#endif
