/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A table for other optics, from the sums per material that another one keeps. Direct light is
 * linear in the optics (docs/theory.md, "Direct light is linear in the optics" and "Other optics");
 * nothing is traced.
 */
#include "error.h"
#include "scene_internal.h"
#include "table_internal.h"
#include "text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct reoptic {
    const srp_table *from;
    srp_table *to;
    bool changed; /* some optics are other than before */
} reoptic;

/* ---- What is refused ------------------------------------------------------------------------ */

/* Nodes whose sums lack what a window has cut off. */
static size_t cut_count(const srp_table *table) {
    size_t count = srp_grid_node_count(table->grid), cut = 0;
    for (size_t k = 0; k < count; ++k) {
        cut += table->filled[k] && (table->nodes[k].flags & SRP_RESPONSE_CUT) != 0;
    }
    return cut;
}

/* Whether light was followed beyond its first hit. With no reflections the part that is known apart
 * is 0, and would be so for any optics. */
static bool follows_light(const srp_table *table) {
    return table->info.has_bounce && table->info.params.reflections > 0;
}

static srp_status check_table(const srp_table *table, bool keep_bounce, srp_error *error) {
    if (!table->info.has_basis) {
        srp_status status =
            srp_fail(error, SRP_UNSUPPORTED,
                     "the table keeps no sums per material, which other optics follow from: make "
                     "it anew with them, as .nc");
        return srp_advise(error, SRP_REMEDY_BASIS, status);
    }
    if (follows_light(table) && !keep_bounce) {
        srp_status status =
            srp_fail(error, SRP_UNSUPPORTED,
                     "the table holds reflected light (method %s), which is not linear in the "
                     "optics: only its direct part can be re-weighted, with the reflected part "
                     "kept as traced",
                     table->info.method);
        return srp_advise(error, SRP_REMEDY_KEEP_BOUNCE, status);
    }
    size_t cut = follows_light(table) ? 0 : cut_count(table);
    if (cut > 0) {
        return srp_fail(error, SRP_UNSUPPORTED,
                        "in %zu nodes part of the model lies outside the sampled window: the sums "
                        "lack it, and what it adds for other optics is not known",
                        cut);
    }
    return SRP_OK;
}

static bool has_material(const srp_table *table, const char *name) {
    for (size_t m = 0; m < table->material_count; ++m) {
        if (strcmp(table->material_names[m], name) == 0) {
            return true;
        }
    }
    return false;
}

static srp_status fail_unknown(const srp_table *table, const char *name, srp_error *error) {
    char names[500] = "";
    size_t used = 0, m = 0;
    for (; m < table->material_count && used + 64 < sizeof names; ++m) {
        int length = snprintf(names + used, sizeof names - used, "%s%s", m > 0 ? ", " : "",
                              srp_string_excerpt(table->material_names[m]).text);
        used += length > 0 ? (size_t)length : 0;
    }
    return srp_fail(error, SRP_NOT_FOUND, "the table has no material %s; its materials are: %s%s",
                    srp_string_excerpt(name).text, names, m < table->material_count ? ", ..." : "");
}

static srp_status check_names(const srp_table *table, const srp_materials *materials,
                              srp_error *error) {
    for (size_t k = 0; k < srp_materials_count(materials); ++k) {
        const char *name = srp_materials_name(materials, k);
        if (!has_material(table, name)) {
            return fail_unknown(table, name, error);
        }
    }
    return SRP_OK;
}

/* ---- What the new table says of itself ------------------------------------------------------- */

static srp_status set_text(const char **slot, const char *text, srp_error *error) {
    return srp_table_set_text(slot, text, strlen(text), error);
}

static srp_status set_materials(reoptic *job, const srp_materials *materials, srp_error *error) {
    const srp_table *from = job->from;
    for (size_t m = 0; m < from->material_count; ++m) {
        const char *name = from->material_names[m];
        const srp_optics before = from->material_optics[m];
        srp_optics optics = before;
        srp_materials_find(materials, name, &optics);
        if (optics.one_sided && !before.one_sided) {
            return srp_fail(error, SRP_UNSUPPORTED,
                            "material %s has two sides in the table: light on its back is in its "
                            "sums, and one-sided it can only be traced anew",
                            srp_string_excerpt(name).text);
        }
        optics.one_sided = before.one_sided;
        job->changed = job->changed || optics.rho_s != before.rho_s || optics.rho_d != before.rho_d;
        srp_status status = srp_table_set_material(job->to, m, name, strlen(name), optics, error);
        if (status != SRP_OK) {
            return status;
        }
    }
    return SRP_OK;
}

static srp_status set_hash(const char **slot, const srp_table *table, srp_error *error) {
    char hash[33];
    if (!srp_optics_hash(table->material_count, table->material_names, table->material_optics, 0.0,
                         hash)) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for the hash of the optics");
    }
    return set_text(slot, hash, error);
}

static srp_status set_origin(reoptic *job, srp_error *error) {
    const srp_table_info *from = &job->from->info;
    srp_table_info *to = &job->to->info;
    bool again = from->traced_optics_hash[0] != '\0';
    const struct {
        const char **slot;
        const char *text;
    } texts[] = {
        {&to->title, from->title},
        {&to->method, from->method},
        {&to->device, from->device},
        {&to->shape_hash, from->shape_hash},
        {&to->version, from->version},
        {&to->traced_optics_hash, again ? from->traced_optics_hash : from->optics_hash},
        {&to->traced_command_line, again ? from->traced_command_line : from->command_line},
    };
    srp_status status = set_hash(&to->optics_hash, job->to, error);
    for (size_t k = 0; status == SRP_OK && k < sizeof texts / sizeof texts[0]; ++k) {
        status = set_text(texts[k].slot, texts[k].text, error);
    }
    /* It also says that there was a trace, so that it is never empty. */
    if (status == SRP_OK && to->traced_optics_hash[0] == '\0') {
        status = set_hash(&to->traced_optics_hash, job->from, error);
    }
    to->params = from->params;
    to->light = from->light;
    to->mass = from->mass;
    to->has_error = from->has_error;
    to->has_moment = from->has_moment;
    to->has_bounce = from->has_bounce;
    to->bounce_kept = follows_light(job->from);
    job->to->has_lattice = job->from->has_lattice;
    return status;
}

/* ---- Numbers --------------------------------------------------------------------------------- */

/* Optics of a row of sums; the last row is the absorbing backs. */
static srp_optics row_optics(const srp_table *table, size_t m) {
    const srp_optics black = {0.0, 0.0, false};
    return m < table->material_count ? table->material_optics[m] : black;
}

/* The push per cross-section of a surface that faces the Sun: no other can push harder. */
static double most_push(const srp_table *table) {
    double most = 1.0;
    for (size_t m = 0; m < table->material_count; ++m) {
        srp_optics optics = table->material_optics[m];
        most = fmax(most, 1.0 + optics.rho_s + 2.0 / 3.0 * optics.rho_d);
    }
    return most;
}

/* Mean push per cross-section of the material that is pushed least, at most 1: a cell that nothing
 * is known of counts with the push of a black one. */
static double least_push(const srp_table *table, const srp_basis *basis, srp_vec3 s) {
    double least = 1.0;
    for (size_t m = 0; m <= table->material_count; ++m) {
        srp_vec3 f = {0.0, 0.0, 0.0}, t = {0.0, 0.0, 0.0};
        srp_basis_apply(&basis[m], row_optics(table, m), s, &f, &t);
        if (basis[m].a > 0.0) {
            least = fmin(least, srp_vec3_norm(f) / basis[m].a);
        }
    }
    return least;
}

/* The errors of sampled sums: the old ones times the growth of pushes, and no more than
 * the push on all that is lit. Exact sums have none. */
static void scale_errors(const reoptic *job, const srp_basis *basis, srp_vec3 s,
                         srp_response *node) {
    double before = node->f_error;
    if (!job->changed || before == 0.0) {
        return;
    }
    double most = most_push(job->to);
    double all = most * (node->lit_area + before);
    node->f_error = fmin(before * (most / least_push(job->from, basis, s)), all);
    node->t_error *= node->f_error / before;
}

/* Whether the tolerance is met, told anew for the new numbers. */
static void set_flags(const srp_method_params *params, srp_response *node) {
    if (isfinite(params->tolerance)) {
        bool missed = node->f_error > params->tolerance * srp_vec3_norm(node->f);
        node->flags &= ~(uint32_t)SRP_RESPONSE_TOLERANCE_MISSED;
        node->flags |= missed ? SRP_RESPONSE_TOLERANCE_MISSED : 0;
    }
}

static void reweigh(const reoptic *job, uint32_t i, uint32_t j) {
    const srp_table *from = job->from;
    srp_table *to = job->to;
    size_t index = srp_table_index(from, i, j), row = from->material_count + 1;
    if (!from->filled[index]) {
        return;
    }
    const srp_basis *basis = &from->basis[index * row];
    srp_vec3 s = srp_grid_direction(from->grid, i, j), f = {0.0, 0.0, 0.0}, t = {0.0, 0.0, 0.0};
    srp_response node = from->nodes[index];
    if (from->info.has_bounce) {
        f = node.f_bounce;
        t = node.t_bounce;
    }
    for (size_t m = 0; m < row; ++m) {
        srp_basis_apply(&basis[m], row_optics(to, m), s, &f, &t);
    }
    node.f = f;
    node.t = t;
    if (!follows_light(from)) {
        scale_errors(job, basis, s, &node);
    }
    set_flags(&from->info.params, &node);
    to->nodes[index] = node;
    memcpy(&to->basis[index * row], basis, row * sizeof *basis);
    srp_table_mark_filled(to, index);
}

srp_status srp_table_reoptic(const srp_table *table, const srp_materials *materials,
                             bool keep_bounce, srp_table **out, srp_error *error) {
    srp_status status = check_table(table, keep_bounce, error);
    if (status == SRP_OK) {
        status = check_names(table, materials, error);
    }
    reoptic job = {table, NULL, false};
    if (status == SRP_OK) {
        status = srp_table_create_blank(table->grid, table->material_count, true, &job.to, error);
    }
    if (status == SRP_OK) {
        status = set_materials(&job, materials, error);
    }
    if (status == SRP_OK) {
        status = set_origin(&job, error);
    }
    if (status != SRP_OK) {
        srp_table_destroy(job.to);
        return status;
    }
    for (uint32_t i = 0; i < table->grid.az_count; ++i) {
        for (uint32_t j = 0; j < table->grid.el_count; ++j) {
            reweigh(&job, i, j);
        }
    }
    *out = job.to;
    return SRP_OK;
}
