/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Filling a table. Nodes that look along the same direction (the two ends of azimuth; all azimuths
 * of a pole) are computed once, at the lowest azimuth, and copied.
 *
 * Directions go to the method in batches, each long enough to keep the threads busy and short
 * enough for progress and cancelling. Batches are sized by the clock; a response depends on its
 * direction alone, so that this shows in no number.
 */
#include "error.h"
#include "table_internal.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* What a batch should take [s]. */
static const double BATCH_SECONDS = 0.25;
/* Most directions of a batch, and most memory for their answers [byte]. */
static const size_t BATCH_MAX = 4096;
static const size_t BATCH_BYTES_MAX = (size_t)16 << 20;
/* Directions per thread of the first batch, and how much the next may differ from the last. */
static const size_t BATCH_FIRST = 2;
static const double BATCH_CHANGE = 8.0;

typedef struct fill_job {
    srp_table *table;
    const srp_prepared *prepared;
    size_t *todo; /* nodes to compute, by index */
    size_t todo_count, done, unique_count;
    size_t capacity; /* of the batch */
    srp_vec3 *directions;
    srp_response *responses;
    srp_basis *basis; /* NULL when not kept */
} fill_job;

size_t srp_table_unique_count(srp_grid grid) {
    return (size_t)(grid.az_count - 1) * (grid.el_count - 2) + 2;
}

static void copy_node(srp_table *table, size_t from, size_t to) {
    if (!table->filled[to]) {
        const size_t row = table->material_count + 1;
        srp_table_put_node(table, to, &table->nodes[from],
                           table->basis != NULL ? &table->basis[from * row] : NULL);
    }
}

void srp_table_put_node(srp_table *table, size_t index, const srp_response *response,
                        const srp_basis *basis) {
    table->nodes[index] = *response;
    if (table->basis != NULL) {
        const size_t row = table->material_count + 1;
        memcpy(&table->basis[index * row], basis, row * sizeof *basis);
    }
    srp_table_mark_filled(table, index);
}

void srp_table_share_node(srp_table *table, size_t index) {
    srp_grid grid = table->grid;
    uint32_t i = (uint32_t)(index / grid.el_count), j = (uint32_t)(index % grid.el_count);
    if (j == 0 || j == grid.el_count - 1) {
        for (uint32_t other = 1; other < grid.az_count; ++other) {
            copy_node(table, index, srp_table_index(table, other, j));
        }
    } else if (i == 0) {
        copy_node(table, index, srp_table_index(table, grid.az_count - 1, j));
    }
}

size_t srp_table_take(srp_table *to, const srp_table *from) {
    const size_t row = to->material_count + 1;
    size_t taken = 0;
    for (uint32_t i = 0; i < to->grid.az_count; ++i) {
        for (uint32_t j = 0; j < to->grid.el_count; ++j) {
            size_t index = srp_table_index(to, i, j);
            if (srp_table_first_index(to, i, j) == index && from->filled[index] &&
                !to->filled[index]) {
                srp_table_put_node(to, index, &from->nodes[index],
                                   from->basis != NULL ? &from->basis[index * row] : NULL);
                srp_table_share_node(to, index);
                ++taken;
            }
        }
    }
    return taken;
}

/* Lists what is left to do, and completes the copies of what is there. */
static void collect(fill_job *job) {
    srp_table *table = job->table;
    srp_grid grid = table->grid;
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            size_t index = srp_table_index(table, i, j);
            if (srp_table_first_index(table, i, j) != index) {
                continue;
            }
            if (table->filled[index]) {
                srp_table_share_node(table, index);
            } else {
                job->todo[job->todo_count++] = index;
            }
        }
    }
    job->done = job->unique_count - job->todo_count;
}

static size_t batch_capacity(const srp_table *table, size_t wanted) {
    size_t bytes = sizeof(srp_vec3) + sizeof(srp_response);
    if (table->basis != NULL) {
        bytes += (table->material_count + 1) * sizeof(srp_basis);
    }
    size_t most = BATCH_BYTES_MAX / bytes;
    most = most < 1 ? 1 : most > BATCH_MAX ? BATCH_MAX : most;
    return wanted < most ? wanted : most;
}

static void job_end(fill_job *job) {
    free(job->todo);
    free(job->directions);
    free(job->responses);
    free(job->basis);
}

static srp_status job_begin(fill_job *job, srp_table *table, const srp_prepared *prepared,
                            srp_error *error) {
    memset(job, 0, sizeof *job);
    job->table = table;
    job->prepared = prepared;
    job->unique_count = srp_table_unique_count(table->grid);
    job->capacity = batch_capacity(table, job->unique_count);
    job->todo = malloc(job->unique_count * sizeof *job->todo);
    job->directions = malloc(job->capacity * sizeof *job->directions);
    job->responses = malloc(job->capacity * sizeof *job->responses);
    if (table->basis != NULL) {
        job->basis = malloc(job->capacity * (table->material_count + 1) * sizeof *job->basis);
    }
    if (job->todo == NULL || job->directions == NULL || job->responses == NULL ||
        (table->basis != NULL && job->basis == NULL)) {
        job_end(job);
        return srp_fail(error, SRP_NO_MEMORY, "no memory to fill a table of %zu nodes",
                        srp_grid_node_count(table->grid));
    }
    collect(job);
    return SRP_OK;
}

static srp_status run_batch(fill_job *job, size_t begin, size_t count, srp_error *error) {
    srp_table *table = job->table;
    for (size_t k = 0; k < count; ++k) {
        size_t index = job->todo[begin + k];
        job->directions[k] =
            srp_grid_direction(table->grid, (uint32_t)(index / table->grid.el_count),
                               (uint32_t)(index % table->grid.el_count));
    }
    srp_status status = srp_prepared_respond(job->prepared, count, job->directions, job->responses,
                                             job->basis, error);
    if (status != SRP_OK) {
        return status;
    }
    size_t row = table->material_count + 1;
    for (size_t k = 0; k < count; ++k) {
        size_t index = job->todo[begin + k];
        srp_table_put_node(table, index, &job->responses[k],
                           job->basis != NULL ? &job->basis[k * row] : NULL);
        srp_table_share_node(table, index);
    }
    job->done += count;
    return SRP_OK;
}

/* Seconds since some fixed time. */
static double now(void) {
    struct timespec time;
    return timespec_get(&time, TIME_UTC) == TIME_UTC
               ? (double)time.tv_sec + 1e-9 * (double)time.tv_nsec
               : 0.0;
}

/* Directions of the next batch after one of `count` that took `seconds`; whole rounds of threads.
 */
static size_t next_batch(const fill_job *job, size_t count, double seconds) {
    double change = seconds > 0.0 ? BATCH_SECONDS / seconds : BATCH_CHANGE;
    change = change > BATCH_CHANGE ? BATCH_CHANGE : change;
    change = change < 1.0 / BATCH_CHANGE ? 1.0 / BATCH_CHANGE : change;
    size_t threads = (size_t)srp_prepared_params(job->prepared)->threads;
    size_t rounds = (size_t)(change * (double)count) / threads;
    size_t next = (rounds < 1 ? 1 : rounds) * threads;
    return next < job->capacity ? next : job->capacity;
}

static bool wants_more(const fill_job *job, const srp_table_progress *progress) {
    return progress == NULL || progress->report == NULL ||
           progress->report(progress->user, job->table, job->done, job->unique_count);
}

srp_status srp_table_fill(srp_table *table, const srp_prepared *prepared,
                          const srp_table_progress *progress, srp_error *error) {
    srp_status status =
        srp_table_check_origin(table, prepared, table->grid, table->info.has_basis, error);
    if (status != SRP_OK) {
        return status;
    }
    fill_job job;
    status = job_begin(&job, table, prepared, error);
    if (status != SRP_OK) {
        return status;
    }
    size_t batch = BATCH_FIRST * (size_t)srp_prepared_params(prepared)->threads;
    batch = batch < job.capacity ? batch : job.capacity;
    bool more = wants_more(&job, progress);
    for (size_t begin = 0; status == SRP_OK && more && begin < job.todo_count;) {
        size_t left = job.todo_count - begin;
        size_t count = batch < left ? batch : left;
        double start = now();
        status = run_batch(&job, begin, count, error);
        if (status == SRP_OK) {
            begin += count;
            batch = next_batch(&job, count, now() - start);
            more = wants_more(&job, progress);
        }
    }
    if (status == SRP_OK && job.done < job.unique_count) {
        status = srp_fail(error, SRP_CANCELLED, "cancelled after %zu of %zu directions", job.done,
                          job.unique_count);
    }
    job_end(&job);
    return status;
}
