/* SPDX-License-Identifier: Apache-2.0 */
/* Files that a mission writes: CCSDS OEM, report, events. */
#include "error.h"
#include "mission_internal.h"
#include "platform.h"

#include <srp/const.h>
#include <srp/orbit/elements.h>

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct srp_mission_file {
    const srp_mission *mission;
    srp_platform_draft draft;
    FILE *out;
    void (*row)(srp_mission_file *file, const srp_mission_row *row);
    void (*event)(srp_mission_file *file, const srp_event *event);
};

static srp_status begin(const char *path, const srp_mission *mission, srp_mission_file **out,
                        srp_error *error) {
    srp_mission_file *file = calloc(1, sizeof *file);
    if (file == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a file");
    }
    srp_status status = srp_platform_draft_begin(path, &file->draft, error);
    if (status != SRP_OK) {
        free(file);
        return status;
    }
    file->mission = mission;
    file->out = fopen(file->draft.path, "w");
    if (file->out == NULL) {
        status = srp_platform_fail_errno(error, path, "write");
        srp_platform_draft_abandon(&file->draft);
        free(file);
        return status;
    }
    *out = file;
    return SRP_OK;
}

/* ---- OEM ------------------------------------------------------------------------------------- */

/* GMAT's A1 is no time system of the standard. */
static srp_time_scale oem_scale(const srp_mission *mission) {
    return mission->info.scale == SRP_TIME_A1 ? SRP_TIME_TAI : mission->info.scale;
}

static void oem_row(srp_mission_file *file, const srp_mission_row *row) {
    char date[SRP_EPOCH_TEXT_SIZE];
    srp_epoch_format(srp_epoch_add(file->mission->info.epoch, row->t), oem_scale(file->mission), 9,
                     date);
    fprintf(file->out, "%s %.9f %.9f %.9f %.12f %.12f %.12f\n", date, 1e-3 * row->r.x,
            1e-3 * row->r.y, 1e-3 * row->r.z, 1e-3 * row->v.x, 1e-3 * row->v.y, 1e-3 * row->v.z);
}

srp_status srp_oem_begin(const char *path, const srp_mission *mission, const char *created,
                         srp_mission_file **out, srp_error *error) {
    srp_mission_file *file = NULL;
    srp_status status = begin(path, mission, &file, error);
    if (status != SRP_OK) {
        return status;
    }
    const srp_mission_info *info = &mission->info;
    char first[SRP_EPOCH_TEXT_SIZE], last[SRP_EPOCH_TEXT_SIZE], centre[32];
    srp_epoch_format(info->epoch, oem_scale(mission), 9, first);
    srp_epoch_format(srp_epoch_add(info->epoch, info->duration), oem_scale(mission), 9, last);
    snprintf(centre, sizeof centre, "%s", srp_celestial_get(info->central)->name);
    for (char *at = centre; *at != '\0'; ++at) {
        *at = (char)toupper((unsigned char)*at);
    }
    fprintf(file->out,
            "CCSDS_OEM_VERS = 2.0\n"
            "CREATION_DATE = %s\n"
            "ORIGINATOR = SRPCORE\n\n"
            "META_START\n"
            "OBJECT_NAME = %s\n"
            "OBJECT_ID = %s\n"
            "CENTER_NAME = %s\n"
            "REF_FRAME = EME2000\n"
            "TIME_SYSTEM = %s\n"
            "START_TIME = %s\n"
            "STOP_TIME = %s\n"
            "META_STOP\n\n",
            created, info->object_name, info->object_id, centre,
            srp_time_scale_name(oem_scale(mission)), first, last);
    if (info->title[0] != '\0') {
        fprintf(file->out, "COMMENT %.200s\n", info->title);
    }
    fprintf(file->out, "COMMENT radiation pressure: %s\n", info->model);
    file->row = oem_row;
    *out = file;
    return SRP_OK;
}

/* ---- Report ---------------------------------------------------------------------------------- */

static const char *const HEADS[SRP_COLUMN_COUNT] = {
    [SRP_COLUMN_ELAPSED] = "elapsed_s",
    [SRP_COLUMN_A1_MJD] = "a1_mjd",
    [SRP_COLUMN_TDB_MJD] = "tdb_mjd",
    [SRP_COLUMN_POSITION] = "x_km,y_km,z_km",
    [SRP_COLUMN_VELOCITY] = "vx_km_s,vy_km_s,vz_km_s",
    [SRP_COLUMN_ELEMENTS] = "a_km,e,i_deg,raan_deg,argp_deg,nu_deg",
    [SRP_COLUMN_SUN] = "s_x,s_y,s_z",
    [SRP_COLUMN_AREA] = "f_x_m2,f_y_m2,f_z_m2",
    [SRP_COLUMN_SRP] = "ax_srp_m_s2,ay_srp_m_s2,az_srp_m_s2",
    [SRP_COLUMN_SEEN] = "seen",
    [SRP_COLUMN_IMPULSE] = "impulse_m_s",
    [SRP_COLUMN_ATTITUDE] = "m11,m12,m13,m21,m22,m23,m31,m32,m33",
    [SRP_COLUMN_NODES] = "nodes",
};

static void put_vector(FILE *out, srp_vec3 v, double factor) {
    fprintf(out, "%.17g,%.17g,%.17g", factor * v.x, factor * v.y, factor * v.z);
}

static void put_elements(FILE *out, double mu, const srp_mission_row *row) {
    const srp_elements el = srp_elements_from_state(mu, row->r, row->v);
    fprintf(out, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", 1e-3 * el.a, el.e, el.i / SRP_RAD_PER_DEG,
            el.raan / SRP_RAD_PER_DEG, el.argp / SRP_RAD_PER_DEG, el.nu / SRP_RAD_PER_DEG);
}

static void put_numbers(FILE *out, const double *values, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        fprintf(out, "%s%.17g", i > 0 ? "," : "", values != NULL ? values[i] : 0.0);
    }
}

static void put_column(FILE *out, const srp_mission_info *info, srp_column column,
                       const srp_mission_row *row) {
    char date[SRP_EPOCH_TEXT_SIZE];
    const srp_epoch now = srp_epoch_add(info->epoch, row->t);
    switch (column) {
    case SRP_COLUMN_EPOCH:
        fputs(srp_epoch_format(now, info->scale, 6, date), out);
        break;
    case SRP_COLUMN_ELAPSED:
        fprintf(out, "%.17g", row->t);
        break;
    case SRP_COLUMN_A1_MJD:
        fprintf(out, "%.17g", srp_epoch_gmat_mjd(now, SRP_TIME_A1));
        break;
    case SRP_COLUMN_TDB_MJD:
        fprintf(out, "%.17g", srp_epoch_gmat_mjd(now, SRP_TIME_TDB));
        break;
    case SRP_COLUMN_POSITION:
        put_vector(out, row->r, 1e-3);
        break;
    case SRP_COLUMN_VELOCITY:
        put_vector(out, row->v, 1e-3);
        break;
    case SRP_COLUMN_ELEMENTS:
        put_elements(out, info->mu, row);
        break;
    case SRP_COLUMN_SUN:
        put_vector(out, row->light.s_body, 1.0);
        break;
    case SRP_COLUMN_AREA:
        put_vector(out, row->light.f, 1.0);
        break;
    case SRP_COLUMN_SRP:
        put_vector(out, row->light.a, 1.0);
        break;
    case SRP_COLUMN_SEEN:
        fprintf(out, "%.17g", row->lit ? row->light.seen : 1.0);
        break;
    case SRP_COLUMN_IMPULSE:
        fprintf(out, "%.17g", row->impulse);
        break;
    case SRP_COLUMN_ATTITUDE:
        put_numbers(out, &row->light.matrix[0][0], 9);
        break;
    case SRP_COLUMN_NODES:
        fprintf(out, "%zu", row->nodes);
        break;
    default:
        put_numbers(out, row->matrix, 36);
        break;
    }
}

static void report_row(srp_mission_file *file, const srp_mission_row *row) {
    const srp_mission_info *info = &file->mission->info;
    for (size_t i = 0; i < info->column_count; ++i) {
        if (i > 0) {
            fputc(',', file->out);
        }
        put_column(file->out, info, info->columns[i], row);
    }
    fputc('\n', file->out);
}

static void put_head(FILE *out, const srp_mission_info *info, srp_column column) {
    if (column == SRP_COLUMN_EPOCH) {
        fprintf(out, "epoch_%s", srp_time_scale_name(info->scale));
    } else if (column == SRP_COLUMN_MATRIX) {
        for (int i = 0; i < 36; ++i) {
            fprintf(out, "%sphi%d%d", i > 0 ? "," : "", i / 6 + 1, i % 6 + 1);
        }
    } else {
        fputs(HEADS[column], out);
    }
}

srp_status srp_report_begin(const char *path, const srp_mission *mission, srp_mission_file **out,
                            srp_error *error) {
    srp_mission_file *file = NULL;
    srp_status status = begin(path, mission, &file, error);
    if (status != SRP_OK) {
        return status;
    }
    for (size_t i = 0; i < mission->info.column_count; ++i) {
        if (i > 0) {
            fputc(',', file->out);
        }
        put_head(file->out, &mission->info, mission->info.columns[i]);
    }
    fputc('\n', file->out);
    file->row = report_row;
    *out = file;
    return SRP_OK;
}

/* ---- Events ---------------------------------------------------------------------------------- */

static void events_event(srp_mission_file *file, const srp_event *event) {
    const srp_mission_info *info = &file->mission->info;
    char date[SRP_EPOCH_TEXT_SIZE];
    srp_epoch_format(srp_epoch_add(info->epoch, event->t), info->scale, 6, date);
    fprintf(file->out, "%s,%s,%s,%.17g,", srp_event_name(event->kind),
            srp_celestial_get(event->body)->name, date, event->t);
    put_vector(file->out, event->r, 1e-3);
    fputc(',', file->out);
    put_vector(file->out, event->v, 1e-3);
    fputc('\n', file->out);
}

srp_status srp_events_begin(const char *path, const srp_mission *mission, srp_mission_file **out,
                            srp_error *error) {
    srp_mission_file *file = NULL;
    srp_status status = begin(path, mission, &file, error);
    if (status != SRP_OK) {
        return status;
    }
    fprintf(file->out, "event,body,epoch_%s,elapsed_s,x_km,y_km,z_km,vx_km_s,vy_km_s,vz_km_s\n",
            srp_time_scale_name(mission->info.scale));
    file->event = events_event;
    *out = file;
    return SRP_OK;
}

/* ---- All ------------------------------------------------------------------------------------- */

static srp_status written(srp_mission_file *file, srp_error *error) {
    return ferror(file->out) == 0 ? SRP_OK
                                  : srp_platform_fail_errno(error, file->draft.target, "write");
}

srp_status srp_mission_file_row(srp_mission_file *file, const srp_mission_row *row,
                                srp_error *error) {
    if (file->row != NULL) {
        const srp_c_locale locale = srp_platform_c_locale_enter();
        errno = 0;
        file->row(file, row);
        srp_platform_c_locale_leave(locale);
    }
    return written(file, error);
}

srp_status srp_mission_file_event(srp_mission_file *file, const srp_event *event,
                                  srp_error *error) {
    if (file->event != NULL) {
        const srp_c_locale locale = srp_platform_c_locale_enter();
        errno = 0;
        file->event(file, event);
        srp_platform_c_locale_leave(locale);
    }
    return written(file, error);
}

srp_status srp_mission_file_commit(srp_mission_file *file, srp_error *error) {
    srp_status status = written(file, error);
    errno = 0;
    if (fclose(file->out) != 0 && status == SRP_OK) {
        status = srp_platform_fail_errno(error, file->draft.target, "write");
    }
    if (status == SRP_OK) {
        status = srp_platform_draft_commit(&file->draft, error);
    } else {
        srp_platform_draft_abandon(&file->draft);
    }
    free(file);
    return status;
}

void srp_mission_file_abandon(srp_mission_file *file) {
    if (file != NULL) {
        fclose(file->out);
        srp_platform_draft_abandon(&file->draft);
        free(file);
    }
}
