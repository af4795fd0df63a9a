/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Wavefront MTL, with our keywords rho_s, rho_d and one_sided. A file is read into a list of its
 * own, which is then merged: the caller's list changes only when all went well.
 */
#include "error.h"
#include "material_internal.h"
#include "platform.h"
#include "text.h"

#include <stdlib.h>

/* A share as the file gives it. */
typedef struct share {
    bool given;
    double value;
    srp_token where; /* the number; {0} for Ks and Kd that are not given */
} share;

typedef struct mtl_reader {
    srp_text text;
    const srp_materials *before; /* the caller's list */
    srp_materials *fresh;        /* what this file says */
    const srp_log *log;
    srp_error *error;
    srp_tally looks, redefined;

    /* The material in work. */
    bool open;
    size_t index; /* in fresh */
    srp_token newmtl;
    share rho_s, rho_d;
    bool one_sided_given, one_sided;
    bool has_ks, has_kd;
    srp_text ks, kd; /* the scanner behind the keyword: read only when they are needed */
} mtl_reader;

static srp_status no_memory(const mtl_reader *reader) {
    return srp_fail_at(reader->error, SRP_NO_MEMORY, reader->text.name, reader->text.line, 0,
                       "no memory for materials");
}

static const char *material_name(const mtl_reader *reader) {
    return reader->fresh->items[reader->index].name;
}

/* ---- Optics of one material --------------------------------------------------------------- */

static srp_status check_share(const mtl_reader *reader, const share *given, const char *keyword) {
    if (given->value >= 0.0 && given->value <= 1.0) {
        return SRP_OK;
    }
    return srp_fail_at(reader->error, SRP_BAD_DATA, reader->text.name, given->where.line,
                       given->where.column, "material %s: %s is %g, expected 0 to 1",
                       srp_string_excerpt(material_name(reader)).text, keyword, given->value);
}

/* Takes two shares, called by the given keywords in messages, as the material's optics. */
static srp_status take_shares(mtl_reader *reader, const share *s, const share *d,
                              const char *s_keyword, const char *d_keyword) {
    srp_status status = check_share(reader, s, s_keyword);
    if (status == SRP_OK) {
        status = check_share(reader, d, d_keyword);
    }
    if (status != SRP_OK) {
        return status;
    }
    srp_optics optics = {s->value, d->value, reader->one_sided};
    if (srp_optics_check(optics, NULL) != SRP_OK) {
        srp_token later = s->where.line > d->where.line ? s->where : d->where;
        return srp_fail_at(reader->error, SRP_BAD_DATA, reader->text.name, later.line, later.column,
                           "material %s: %s + %s is %g, expected at most 1 (the rest is absorbed)",
                           srp_string_excerpt(material_name(reader)).text, s_keyword, d_keyword,
                           s->value + d->value);
    }
    reader->fresh->items[reader->index].optics = optics;
    reader->fresh->items[reader->index].known = true;
    return SRP_OK;
}

/* Ks or Kd: one number, or three that must be equal. */
static srp_status read_channels(const mtl_reader *reader, srp_text text, const char *keyword,
                                share *out) {
    double channel[3];
    srp_token token;
    srp_status status = srp_text_double(&text, keyword, &channel[0], &out->where, reader->error);
    if (status != SRP_OK) {
        return status;
    }
    channel[1] = channel[2] = channel[0];
    if (srp_text_next_token(&text, &token)) {
        status = srp_token_double(&text, token, keyword, &channel[1], reader->error);
        if (status == SRP_OK) {
            status = srp_text_double(&text, keyword, &channel[2], NULL, reader->error);
        }
        if (status != SRP_OK) {
            return status;
        }
    }
    if (channel[0] != channel[1] || channel[0] != channel[2]) {
        const char *name = material_name(reader);
        status = srp_fail_at(
            reader->error, SRP_BAD_DATA, reader->text.name, out->where.line, out->where.column,
            "material %s: %s is %g %g %g, expected three equal channels; give rho_s and rho_d "
            "in the file",
            srp_string_excerpt(name).text, keyword, channel[0], channel[1], channel[2]);
        return srp_advise(reader->error, SRP_REMEDY_OPTICS, status);
    }
    out->given = true;
    out->value = channel[0];
    return SRP_OK;
}

/* Optics from what was made for looks. One of the two that is not given is black: 0. */
static srp_status take_looks(mtl_reader *reader) {
    share ks = {.value = 0.0}, kd = {.value = 0.0};
    srp_status status = SRP_OK;
    if (reader->has_ks) {
        status = read_channels(reader, reader->ks, "Ks", &ks);
    }
    if (status == SRP_OK && reader->has_kd) {
        status = read_channels(reader, reader->kd, "Kd", &kd);
    }
    if (status == SRP_OK) {
        status = take_shares(reader, &ks, &kd, "Ks", "Kd");
    }
    if (status == SRP_OK && srp_tally_shows(&reader->looks)) {
        srp_warn_at(reader->log, reader->text.name, reader->newmtl.line, reader->newmtl.column,
                    "material %s: rho_s = %g is taken from Ks%s and rho_d = %g from Kd%s, which "
                    "were made for looks; give rho_s and rho_d",
                    srp_string_excerpt(material_name(reader)).text, ks.value,
                    ks.given ? "" : " (not given)", kd.value, kd.given ? "" : " (not given)");
    }
    return status;
}

/* What the user has pinned is not looked at: it does not count. */
static bool is_pinned(const mtl_reader *reader) {
    const srp_material *known = srp_materials_get(reader->before, material_name(reader));
    return known != NULL && known->pinned;
}

static srp_status finish_material(mtl_reader *reader) {
    if (!reader->open || is_pinned(reader)) {
        return SRP_OK;
    }
    if (reader->rho_s.given && reader->rho_d.given) {
        return take_shares(reader, &reader->rho_s, &reader->rho_d, "rho_s", "rho_d");
    }
    if (reader->rho_s.given || reader->rho_d.given) {
        return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, reader->newmtl.line,
                           reader->newmtl.column, "material %s has %s but no %s, expected both",
                           srp_string_excerpt(material_name(reader)).text,
                           reader->rho_s.given ? "rho_s" : "rho_d",
                           reader->rho_s.given ? "rho_d" : "rho_s");
    }
    return reader->has_ks || reader->has_kd ? take_looks(reader) : SRP_OK;
}

/* ---- Statements --------------------------------------------------------------------------- */

static srp_status begin_material(mtl_reader *reader, srp_token keyword) {
    srp_token token = srp_text_rest(&reader->text);
    if (token.size == 0) {
        return srp_text_expected(&reader->text, token, "the name of a material", reader->error);
    }
    char *name = srp_token_name(token);
    size_t count = srp_materials_count(reader->fresh);
    srp_material *material = name == NULL ? NULL : srp_materials_touch(reader->fresh, name);
    free(name);
    if (material == NULL) {
        return no_memory(reader);
    }
    if (srp_materials_count(reader->fresh) == count && srp_tally_shows(&reader->redefined)) {
        srp_warn_at(reader->log, reader->text.name, token.line, token.column,
                    "material %s is defined before in this file: the later definition holds",
                    srp_string_excerpt(material->name).text);
    }
    material->known = false;
    reader->open = true;
    reader->index = (size_t)(material - reader->fresh->items);
    reader->newmtl = keyword;
    reader->rho_s.given = reader->rho_d.given = false;
    reader->one_sided_given = reader->one_sided = false;
    reader->has_ks = reader->has_kd = false;
    return SRP_OK;
}

static srp_status check_first(const mtl_reader *reader, srp_token keyword, bool given) {
    if (!reader->open) {
        return srp_text_expected(&reader->text, keyword, "newmtl NAME before it", reader->error);
    }
    if (given) {
        return srp_fail_at(reader->error, SRP_BAD_FORMAT, reader->text.name, keyword.line,
                           keyword.column, "material %s has two statements %.*s, expected one",
                           srp_string_excerpt(material_name(reader)).text, (int)keyword.size,
                           keyword.text);
    }
    return SRP_OK;
}

static srp_status read_share(mtl_reader *reader, srp_token keyword, const char *what, share *out) {
    srp_status status = check_first(reader, keyword, out->given);
    if (status == SRP_OK) {
        status = srp_text_double(&reader->text, what, &out->value, &out->where, reader->error);
    }
    if (status == SRP_OK) {
        status = srp_text_end_of_line(&reader->text, reader->error);
    }
    out->given = true;
    return status;
}

static srp_status read_one_sided(mtl_reader *reader, srp_token keyword) {
    int64_t value = 0;
    srp_status status = check_first(reader, keyword, reader->one_sided_given);
    if (status == SRP_OK) {
        status = srp_text_integer(&reader->text, "one_sided", 0, 1, &value, NULL, reader->error);
    }
    if (status == SRP_OK) {
        status = srp_text_end_of_line(&reader->text, reader->error);
    }
    reader->one_sided_given = true;
    reader->one_sided = value == 1;
    return status;
}

static srp_status read_statement(mtl_reader *reader) {
    srp_token keyword;
    srp_text_next_token(&reader->text, &keyword);
    if (srp_token_is(keyword, "newmtl")) {
        srp_status status = finish_material(reader);
        return status == SRP_OK ? begin_material(reader, keyword) : status;
    }
    if (srp_token_is(keyword, "rho_s")) {
        return read_share(reader, keyword, "rho_s", &reader->rho_s);
    }
    if (srp_token_is(keyword, "rho_d")) {
        return read_share(reader, keyword, "rho_d", &reader->rho_d);
    }
    if (srp_token_is(keyword, "one_sided")) {
        return read_one_sided(reader, keyword);
    }
    if (srp_token_is(keyword, "Ks")) {
        reader->has_ks = true;
        reader->ks = reader->text;
    } else if (srp_token_is(keyword, "Kd")) {
        reader->has_kd = true;
        reader->kd = reader->text;
    }
    return SRP_OK;
}

static srp_status read_file(mtl_reader *reader) {
    srp_status status = SRP_OK;
    while (status == SRP_OK && srp_text_next_line(&reader->text)) {
        status = read_statement(reader);
    }
    if (status == SRP_OK) {
        status = finish_material(reader);
    }
    srp_tally_close(&reader->looks, reader->log, reader->text.name,
                    "materials taken from Ks and Kd");
    srp_tally_close(&reader->redefined, reader->log, reader->text.name,
                    "materials defined more than once");
    if (status == SRP_OK && srp_materials_count(reader->fresh) == 0) {
        srp_warn_at(reader->log, reader->text.name, 0, 0, "the file defines no material (newmtl)");
    }
    return status;
}

/* ---- The whole ---------------------------------------------------------------------------- */

static bool same_optics(srp_optics a, srp_optics b) {
    return a.rho_s == b.rho_s && a.rho_d == b.rho_d && a.one_sided == b.one_sided;
}

/* Puts what the file says into `into`, a copy of the caller's list. */
static srp_status merge(const mtl_reader *reader, srp_materials *into) {
    srp_tally changed = {0};
    for (size_t i = 0; i < reader->fresh->count; i++) {
        const srp_material *item = &reader->fresh->items[i];
        srp_material *target = srp_materials_touch(into, item->name);
        if (target == NULL) {
            return no_memory(reader);
        }
        if (!item->known || target->pinned) {
            continue;
        }
        if (target->known && !same_optics(target->optics, item->optics) &&
            srp_tally_shows(&changed)) {
            srp_warn_at(reader->log, reader->text.name, 0, 0,
                        "material %s has other optics in this file than before: these hold",
                        srp_string_excerpt(item->name).text);
        }
        target->optics = item->optics;
        target->known = true;
    }
    srp_tally_close(&changed, reader->log, reader->text.name, "materials with other optics");
    return SRP_OK;
}

srp_status srp_materials_parse_mtl(srp_materials *materials, const char *text, size_t size,
                                   const char *name, const srp_log *log, srp_error *error) {
    mtl_reader reader = {.before = materials, .log = log, .error = error};
    srp_status status = srp_text_open(&reader.text, text, size, name,
                                      SRP_TEXT_COMMENTS | SRP_TEXT_CONTINUED_LINES, error);
    if (status != SRP_OK) {
        return status;
    }
    srp_materials *merged = srp_materials_clone(materials);
    status = srp_materials_create(&reader.fresh, error);
    if (merged == NULL) {
        status = no_memory(&reader);
    }
    if (status == SRP_OK) {
        srp_c_locale locale = srp_platform_c_locale_enter();
        status = read_file(&reader);
        srp_platform_c_locale_leave(locale);
    }
    if (status == SRP_OK) {
        status = merge(&reader, merged);
    }
    if (status == SRP_OK) {
        srp_materials old = *materials;
        *materials = *merged;
        *merged = old;
    }
    srp_materials_destroy(merged);
    srp_materials_destroy(reader.fresh);
    return status;
}

srp_status srp_materials_read_mtl(srp_materials *materials, const char *path, const srp_log *log,
                                  srp_error *error) {
    char *text;
    size_t size;
    srp_status status = srp_text_read_file(path, &text, &size, error);
    if (status != SRP_OK) {
        return status;
    }
    status = srp_materials_parse_mtl(materials, text, size, path, log, error);
    free(text);
    return status;
}
