/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A directory that remembers tables: one .nc file for each table, named by a key of everything that
 * decides its numbers (shape, optics, method, device, parameters, grid, version of library and
 * format). A file holds the nodes that are known so far, and may be read like any table.
 *
 * Any number of processes and threads may fill the same table: each adds its nodes to those that
 * are there, under a lock of the directory, and the file is replaced at once. A process that dies
 * leaves the file as it was. A file that cannot be understood is set aside under the name
 * KEY.nc.damaged, said through the log, and its nodes are computed again. When the files exceed the
 * size limit, those that were not used for the longest time are removed.
 *
 * docs/file-formats.md, "Cache", describes the directory.
 */
#ifndef SRP_CACHE_H
#define SRP_CACHE_H

#include <srp/method.h>
#include <srp/status.h>
#include <srp/table.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

typedef struct srp_cache srp_cache;

typedef struct srp_cache_params {
    /* NULL: that of the user, srpcore in $XDG_CACHE_HOME, or in ~/.cache where that is not an
     * absolute path. Made when it is first written to. */
    const char *directory;
    uint64_t size_max; /* [byte] of all files together */
    /* A table that fills itself is written when it is destroyed and, by the thread that has just
     * computed, when this much is new and writing takes no larger share of the time: the whole
     * table is written, which takes seconds where the grid is fine. */
    size_t flush_nodes;   /* > 0 */
    double flush_seconds; /* >= 0 [s] since it was last written, if anything is new */
    double flush_share;   /* >= 0; of the time since then that the last writing took */
    double wait_seconds;  /* >= 0 [s] that a lock is waited for before the cache is done without */
} srp_cache_params;

/* The user's directory, 1 GiB, 4096 nodes, 10 s, 0.05, 10 s. */
SRP_API srp_cache_params srp_cache_params_default(void);

/*
 * Touches no file. `log` (may be NULL) is told, once for each table, when the directory cannot be
 * used, and of each file that is set aside; from any thread that uses a table of it. SRP_NOT_FOUND
 * (no directory given, and neither XDG_CACHE_HOME nor HOME is set), SRP_BAD_ARGUMENT,
 * SRP_NO_MEMORY. Ownership: *out is the caller's.
 */
SRP_API SRP_CHECK srp_status srp_cache_open(const srp_cache_params *params, const srp_log *log,
                                            srp_cache **out, srp_error *error);
SRP_API void srp_cache_close(srp_cache *cache);
SRP_API const char *srp_cache_directory(const srp_cache *cache);

/*
 * Gives `table`, made for `prepared`, the nodes that the cache has and it lacks, and the cache
 * those that it lacks. Nodes are the same to the bit wherever they come from. *found (may be NULL)
 * counts the directions that came from the cache. SRP_MISMATCH (`table` is not of `prepared`),
 * SRP_IO, SRP_NO_MEMORY; `table` is then as good as before, and may have gained nodes: a cache that
 * can be read and not written gives what it has, and SRP_IO unless that is all. Any thread.
 */
SRP_API SRP_CHECK srp_status srp_cache_exchange(srp_cache *cache, const srp_prepared *prepared,
                                                srp_table *table, size_t *found, srp_error *error);

/*
 * The half of it that changes no table: for one that is being filled, from the callback of its
 * progress. The same statuses. Any thread.
 */
SRP_API SRP_CHECK srp_status srp_cache_keep(srp_cache *cache, const srp_prepared *prepared,
                                            const srp_table *table, srp_error *error);

typedef struct srp_cache_entry {
    char name[64];   /* of the file in the directory */
    uint64_t size;   /* [byte] */
    int64_t used;    /* when it was last used [s since 1970] */
    bool is_damaged; /* set aside */
} srp_cache_entry;

/* What there is, the last used first; none where there is no directory. *entries is freed by
 * srp_cache_entries_free(). SRP_IO, SRP_NO_MEMORY. */
SRP_API SRP_CHECK srp_status srp_cache_list(const srp_cache *cache, srp_cache_entry **entries,
                                            size_t *count, srp_error *error);
SRP_API void srp_cache_entries_free(srp_cache_entry *entries);

/* Removes all files of the cache, and nothing else; *removed (may be NULL) counts them. SRP_IO. */
SRP_API SRP_CHECK srp_status srp_cache_clear(srp_cache *cache, size_t *removed, srp_error *error);

SRP_END_DECLS

#endif
