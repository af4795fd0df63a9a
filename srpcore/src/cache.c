/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The cache on disk. Everything happens under one lock of the directory, which ends with the
 * process that holds it, and files are replaced at once: whoever dies, at whatever moment, leaves
 * each file as it was or as it was meant to be, and at most a draft that the next one removes.
 */
#include "cache_internal.h"
#include "error.h"
#include "platform.h"
#include "table_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ENDING ".nc"
#define ASIDE ".damaged"
#define DRAFT ".tmp"
#define LOCK_NAME "lock"
enum { KEY_SIZE = 32 };

struct srp_cache {
    srp_cache_params params; /* params.directory is `directory` */
    srp_log log;
    char *directory;
};

srp_cache_params srp_cache_params_default(void) {
    srp_cache_params params = {
        .directory = NULL,
        .size_max = (uint64_t)1 << 30,
        .flush_nodes = 4096,
        .flush_seconds = 10.0,
        .flush_share = 0.05,
        .wait_seconds = 10.0,
    };
    return params;
}

/* ---- Making and ending ---------------------------------------------------------------------- */

static srp_status choose_directory(const char *given, char **out, srp_error *error) {
    if (given == NULL) {
        return srp_platform_cache_directory("srpcore", out, error);
    }
    if (given[0] == '\0') {
        return srp_fail(error, SRP_BAD_ARGUMENT, "the cache's directory has no name");
    }
    size_t size = strlen(given) + 1;
    char *copy = malloc(size);
    if (copy == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a path of %zu bytes", size);
    }
    memcpy(copy, given, size);
    *out = copy;
    return SRP_OK;
}

srp_status srp_cache_open(const srp_cache_params *params, const srp_log *log, srp_cache **out,
                          srp_error *error) {
    if (params->flush_nodes < 1 || !(params->flush_seconds >= 0.0) ||
        !(params->flush_share >= 0.0) || !(params->wait_seconds >= 0.0)) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "a cache written after %zu nodes or %g s, for a share of %g of the time, "
                        "waited for %g s: expected at least 1, 0, 0, 0",
                        params->flush_nodes, params->flush_seconds, params->flush_share,
                        params->wait_seconds);
    }
    char *directory;
    srp_status status = choose_directory(params->directory, &directory, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_cache *cache = calloc(1, sizeof *cache);
    if (cache == NULL) {
        free(directory);
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a cache");
    }
    cache->params = *params;
    cache->params.directory = directory;
    cache->directory = directory;
    if (log != NULL) {
        cache->log = *log;
    }
    *out = cache;
    return SRP_OK;
}

void srp_cache_close(srp_cache *cache) {
    if (cache != NULL) {
        free(cache->directory);
        free(cache);
    }
}

const char *srp_cache_directory(const srp_cache *cache) {
    return cache->directory;
}

const srp_cache_params *srp_cache_get_params(const srp_cache *cache) {
    return &cache->params;
}

void srp_cache_warn(const srp_cache *cache, const srp_error *why) {
    srp_warn_at(&cache->log, why->file, why->line, why->column,
                "%.500s; what is computed is not kept until that is mended", why->message);
}

/* ---- Names ---------------------------------------------------------------------------------- */

/* DIRECTORY/NAME MORE, freed by free(). */
static srp_status path_of(const srp_cache *cache, const char *name, const char *more, char **out,
                          srp_error *error) {
    size_t size = strlen(cache->directory) + strlen(name) + strlen(more) + 2;
    char *path = malloc(size);
    if (path == NULL) {
        return srp_fail_at(error, SRP_NO_MEMORY, cache->directory, 0, 0,
                           "no memory for a path of %zu bytes", size);
    }
    snprintf(path, size, "%s/%s%s", cache->directory, name, more);
    *out = path;
    return SRP_OK;
}

/* What a file of the directory is. */
typedef enum file_kind { FILE_FOREIGN, FILE_TABLE, FILE_ASIDE, FILE_DRAFT } file_kind;

static file_kind kind_of(const char *name) {
    if (strspn(name, "0123456789abcdef") != KEY_SIZE ||
        strncmp(name + KEY_SIZE, ENDING, sizeof ENDING - 1) != 0) {
        return FILE_FOREIGN;
    }
    const char *rest = name + KEY_SIZE + sizeof ENDING - 1;
    size_t length = strlen(rest), draft = sizeof DRAFT - 1;
    if (length == 0) {
        return FILE_TABLE;
    }
    if (strcmp(rest, ASIDE) == 0) {
        return FILE_ASIDE;
    }
    return length > draft && strcmp(rest + length - draft, DRAFT) == 0 ? FILE_DRAFT : FILE_FOREIGN;
}

/* ---- The lock ------------------------------------------------------------------------------- */

/* *lock is -1 if the cache is in use and that is no failure. */
static srp_status take_lock(const srp_cache *cache, bool wait, int *lock, srp_error *error) {
    char *path = NULL;
    srp_status status = srp_platform_make_directory(cache->directory, error);
    if (status == SRP_OK) {
        status = path_of(cache, LOCK_NAME, "", &path, error);
    }
    if (status != SRP_OK) {
        return status;
    }
    double seconds = wait ? cache->params.wait_seconds : 0.0;
    status = srp_platform_lock_file(path, seconds, lock, error);
    if (status == SRP_OK && *lock < 0 && wait) {
        status = srp_fail_at(error, SRP_IO, path, 0, 0,
                             "another program has locked the cache for more than %g s", seconds);
    }
    free(path);
    return status;
}

/* ---- Listing and removing ------------------------------------------------------------------- */

typedef struct file_list {
    srp_cache_entry *entries; /* used: in ns while the list is made */
    size_t count, capacity;
    bool drafts; /* these, instead of tables */
    bool is_short_of_memory;
} file_list;

static bool see_file(void *user, const srp_platform_file *file) {
    file_list *list = user;
    file_kind kind = kind_of(file->name);
    srp_cache_entry entry = {.size = file->size, .used = file->changed};
    if (kind == FILE_FOREIGN || (kind == FILE_DRAFT) != list->drafts ||
        strlen(file->name) >= sizeof entry.name) {
        return true;
    }
    if (list->count == list->capacity) {
        size_t capacity = list->capacity == 0 ? 64 : 2 * list->capacity;
        srp_cache_entry *larger = realloc(list->entries, capacity * sizeof *larger);
        if (larger == NULL) {
            list->is_short_of_memory = true;
            return false;
        }
        list->entries = larger;
        list->capacity = capacity;
    }
    strcpy(entry.name, file->name);
    entry.is_damaged = kind == FILE_ASIDE;
    list->entries[list->count++] = entry;
    return true;
}

/* The last used first. */
static int by_use(const void *a, const void *b) {
    const srp_cache_entry *x = a, *y = b;
    return x->used != y->used ? (x->used < y->used ? 1 : -1) : strcmp(x->name, y->name);
}

static srp_status list_files(const srp_cache *cache, bool drafts, file_list *out,
                             srp_error *error) {
    file_list list = {.drafts = drafts};
    srp_error ours;
    srp_status status = srp_platform_list_files(cache->directory, see_file, &list, &ours);
    if (status == SRP_OK && list.is_short_of_memory) {
        status = srp_fail_at(&ours, SRP_NO_MEMORY, cache->directory, 0, 0,
                             "no memory to list the cache");
    }
    if (status != SRP_OK && status != SRP_NOT_FOUND) {
        free(list.entries);
        if (error != NULL) {
            *error = ours;
        }
        return status;
    }
    if (list.count > 0) {
        qsort(list.entries, list.count, sizeof *list.entries, by_use);
    }
    *out = list;
    return SRP_OK;
}

srp_status srp_cache_list(const srp_cache *cache, srp_cache_entry **entries, size_t *count,
                          srp_error *error) {
    file_list list;
    srp_status status = list_files(cache, false, &list, error);
    if (status != SRP_OK) {
        return status;
    }
    for (size_t k = 0; k < list.count; ++k) {
        list.entries[k].used /= 1000000000;
    }
    *entries = list.entries;
    *count = list.count;
    return SRP_OK;
}

void srp_cache_entries_free(srp_cache_entry *entries) {
    free(entries);
}

/* A file that is gone already is as good. */
static srp_status remove_file(const srp_cache *cache, const char *name, srp_error *error) {
    char *path = NULL;
    srp_status status = path_of(cache, name, "", &path, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_platform_remove_file(path, error);
    free(path);
    return status == SRP_NOT_FOUND ? SRP_OK : status;
}

static srp_status remove_all(const srp_cache *cache, bool drafts, size_t *removed,
                             srp_error *error) {
    file_list list;
    srp_status status = list_files(cache, drafts, &list, error);
    if (status != SRP_OK) {
        return status;
    }
    for (size_t k = 0; k < list.count && status == SRP_OK; ++k) {
        status = remove_file(cache, list.entries[k].name, error);
        *removed += status == SRP_OK;
    }
    free(list.entries);
    return status;
}

/* Removes what was not used for the longest time, until the rest fits; `name`, just written, stays.
 */
static srp_status prune(const srp_cache *cache, const char *name, srp_error *error) {
    file_list list;
    srp_status status = list_files(cache, false, &list, error);
    if (status != SRP_OK) {
        return status;
    }
    uint64_t total = 0;
    for (size_t k = 0; k < list.count; ++k) {
        total += list.entries[k].size;
    }
    for (size_t k = list.count; k-- > 0 && total > cache->params.size_max && status == SRP_OK;) {
        const srp_cache_entry *entry = &list.entries[k];
        if (strncmp(entry->name, name, KEY_SIZE) != 0 || entry->is_damaged) {
            status = remove_file(cache, entry->name, error);
            total -= entry->size;
        }
    }
    free(list.entries);
    return status;
}

srp_status srp_cache_clear(srp_cache *cache, size_t *removed, srp_error *error) {
    size_t tables = 0, drafts = 0;
    int lock;
    srp_status status = take_lock(cache, true, &lock, error);
    if (status != SRP_OK) {
        return status;
    }
    status = remove_all(cache, false, &tables, error);
    if (status == SRP_OK) {
        status = remove_all(cache, true, &drafts, error);
    }
    srp_platform_unlock_file(lock);
    if (status == SRP_OK && removed != NULL) {
        *removed = tables;
    }
    return status;
}

/* ---- Exchanging ----------------------------------------------------------------------------- */

/* Renames a file that cannot be used, and says so. */
static srp_status set_aside(const srp_cache *cache, const char *path, const char *key,
                            const srp_error *why, srp_error *error) {
    char *aside = NULL;
    srp_status status = path_of(cache, key, ENDING ASIDE, &aside, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_platform_rename_file(path, aside, error);
    if (status == SRP_OK) {
        srp_warn_at(&cache->log, path, why->line, why->column,
                    "%.400s; it is set aside as '%s%s%s', and computed again", why->message, key,
                    ENDING, ASIDE);
    }
    free(aside);
    return status;
}

/* What the file holds; *out stays as it is where there is none, or none that is of use: that is set
 * aside, or without a key left, and its status returned. */
static srp_status read_kept(const srp_cache *cache, const srp_cache_job *job, const char *path,
                            const char *key, srp_table **out, srp_error *error) {
    srp_table *table = NULL;
    srp_error why;
    srp_status status = srp_table_read(&srp_table_format_netcdf, path, &table, &why);
    if (status == SRP_OK) {
        status = srp_table_check_origin(table, job->prepared, job->grid, job->with_basis, &why);
    }
    switch (status) {
    case SRP_OK:
        srp_table_destroy(*out);
        *out = table;
        return SRP_OK;
    case SRP_NOT_FOUND:
        return SRP_OK;
    case SRP_NO_MEMORY:
    case SRP_IO:
        srp_table_destroy(table);
        if (error != NULL) {
            *error = why;
        }
        return status;
    default:
        srp_table_destroy(table);
        return key != NULL ? set_aside(cache, path, key, &why, error) : status;
    }
}

/* Under the lock. *kept is an empty table to begin with. */
static srp_status exchange(const srp_cache *cache, const srp_cache_job *job, srp_table **kept,
                           srp_error *error) {
    char key[KEY_SIZE + 1], *path = NULL;
    size_t drafts = 0;
    srp_table_key(*kept, key);
    srp_status status = path_of(cache, key, ENDING, &path, error);
    if (status != SRP_OK) {
        return status;
    }
    status = read_kept(cache, job, path, key, kept, error);
    if (status != SRP_OK) {
        free(path);
        return status;
    }
    bool gained = job->join(job->user, *kept) > 0;
    status = remove_all(cache, true, &drafts, error);
    if (status == SRP_OK && gained) {
        status = srp_table_write(*kept, &srp_table_format_netcdf, path, error);
        if (status == SRP_OK) {
            status = prune(cache, key, error);
        }
    } else if (status == SRP_OK) {
        srp_platform_touch_file(path);
    }
    free(path);
    return status;
}

/* Takes nodes without the lock: files are replaced at once, so that what is read is whole. Whether
 * all nodes are there: then there is nothing to be kept, either. */
static bool look(const srp_cache *cache, const srp_cache_job *job) {
    char key[KEY_SIZE + 1], *path = NULL;
    srp_table *kept = NULL;
    bool all = false;
    if (srp_table_create(job->prepared, job->grid, job->with_basis, &kept, NULL) != SRP_OK) {
        return false;
    }
    srp_table_key(kept, key);
    if (path_of(cache, key, ENDING, &path, NULL) == SRP_OK &&
        read_kept(cache, job, path, NULL, &kept, NULL) == SRP_OK) {
        all = srp_table_is_complete(kept);
        (void)job->join(job->user, kept);
    }
    free(path);
    srp_table_destroy(kept);
    return all;
}

srp_status srp_cache_run(srp_cache *cache, const srp_cache_job *job, srp_error *error) {
    srp_table *kept;
    int lock;
    srp_status status = take_lock(cache, job->wait, &lock, error);
    if (status != SRP_OK) {
        return status == SRP_IO && job->looks_anyway && look(cache, job) ? SRP_OK : status;
    }
    if (lock < 0) {
        return SRP_OK;
    }
    status = srp_table_create(job->prepared, job->grid, job->with_basis, &kept, error);
    if (status == SRP_OK) {
        status = exchange(cache, job, &kept, error);
        srp_table_destroy(kept);
    }
    srp_platform_unlock_file(lock);
    return status;
}

typedef struct table_join {
    srp_table *table;
    size_t found;
} table_join;

static size_t join_table(void *user, srp_table *kept) {
    table_join *join = user;
    size_t gained = srp_table_take(kept, join->table);
    join->found = srp_table_take(join->table, kept);
    return gained;
}

static size_t give_table(void *user, srp_table *kept) {
    const srp_table *const *table = user;
    return srp_table_take(kept, *table);
}

srp_status srp_cache_exchange(srp_cache *cache, const srp_prepared *prepared, srp_table *table,
                              size_t *found, srp_error *error) {
    bool with_basis = table->info.has_basis;
    srp_status status = srp_table_check_origin(table, prepared, table->grid, with_basis, error);
    if (status != SRP_OK) {
        return status;
    }
    table_join join = {table, 0};
    srp_cache_job job = {prepared, table->grid, with_basis, true, true, join_table, &join};
    status = srp_cache_run(cache, &job, error);
    if (status == SRP_OK && found != NULL) {
        *found = join.found;
    }
    return status;
}

srp_status srp_cache_keep(srp_cache *cache, const srp_prepared *prepared, const srp_table *table,
                          srp_error *error) {
    bool with_basis = table->info.has_basis;
    srp_status status = srp_table_check_origin(table, prepared, table->grid, with_basis, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_cache_job job = {prepared, table->grid, with_basis, true, false, give_table, &table};
    return srp_cache_run(cache, &job, error);
}
