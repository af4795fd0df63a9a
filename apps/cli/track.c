/* SPDX-License-Identifier: Apache-2.0 */
#include "track.h"

#include "command.h"
#include "messages.h"
#include "methods.h"

#include <stdio.h>
#include <stdlib.h>

static const srp_method *find_method(void *user, const char *name, const char *device) {
    (void)user;
    return cli_method_find(name, device);
}

srp_status cli_mission_read(const char *path, srp_mission **out, srp_error *error) {
    const srp_log log = cli_log();
    const srp_cache_params cache = srp_cache_params_default();
    const srp_mission_context context = {&log, find_method, NULL, &cache};
    return srp_mission_read(path, &context, out, error);
}

static bool make_room(cli_track *to) {
    const size_t capacity = 2 * to->capacity + 256;
    srp_vec3 *r = realloc(to->r, capacity * sizeof *r);
    to->r = r != NULL ? r : to->r;
    srp_vec3 *v = realloc(to->v, capacity * sizeof *v);
    to->v = v != NULL ? v : to->v;
    double *t = realloc(to->t, capacity * sizeof *t);
    to->t = t != NULL ? t : to->t;
    if (r == NULL || v == NULL || t == NULL) {
        return false;
    }
    to->capacity = capacity;
    return true;
}

srp_status cli_track_add(cli_track *to, const srp_mission_row *row, srp_error *error) {
    if (to->count == to->capacity && !make_room(to)) {
        *error = (srp_error){.status = SRP_NO_MEMORY};
        snprintf(error->message, sizeof error->message, "no memory for %zu rows", to->count);
        return SRP_NO_MEMORY;
    }
    to->r[to->count] = row->r;
    to->v[to->count] = row->v;
    to->t[to->count++] = row->t;
    return SRP_OK;
}

void cli_track_free(cli_track *t) {
    free(t->r);
    free(t->v);
    free(t->t);
    *t = (cli_track){.count = 0};
}

srp_vec3 cli_track_difference(const cli_track *a, const cli_track *b, size_t i) {
    const srp_vec3 d = srp_vec3_sub(b->r[i], a->r[i]);
    const srp_vec3 h = srp_vec3_cross(a->r[i], a->v[i]);
    const srp_vec3 radial = srp_vec3_scale(1.0 / srp_vec3_norm(a->r[i]), a->r[i]);
    const srp_vec3 cross = srp_vec3_scale(1.0 / srp_vec3_norm(h), h);
    return srp_vec3_make(srp_vec3_dot(d, radial), srp_vec3_dot(d, srp_vec3_cross(cross, radial)),
                         srp_vec3_dot(d, cross));
}

double cli_track_distance(const cli_track *a, const cli_track *b, size_t i) {
    return srp_vec3_norm(srp_vec3_sub(b->r[i], a->r[i]));
}

void cli_rows_begin(FILE *out, bool is_difference) {
    fprintf(out, "elapsed_s,%s,distance_m\n",
            is_difference ? "radial_m,along_m,cross_m" : "x_m,y_m,z_m");
}

void cli_rows_put(FILE *out, double t, srp_vec3 along, double distance) {
    fprintf(out, "%.17g,%.9g,%.9g,%.9g,%.9g\n", t, along.x, along.y, along.z, distance);
}

int cli_missions_check_pair(const srp_mission *a, const srp_mission *b) {
    const srp_mission_info *one = srp_mission_get_info(a), *other = srp_mission_get_info(b);
    const struct {
        const char *name;
        bool same;
    } all[] = {{"epoch", srp_epoch_difference(one->epoch, other->epoch) == 0.0},
               {"duration", one->duration == other->duration},
               {"output.step", one->step == other->step},
               {"central_body", one->central == other->central}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        if (!all[i].same) {
            cli_say_of_file("%s: its %s differs from that of %s, expected the same", other->file,
                            all[i].name, one->file);
            return CLI_BAD_INPUT;
        }
    }
    return CLI_DONE;
}
