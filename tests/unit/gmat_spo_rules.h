/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The rules by which GMAT (R2020a to R2026a) reads a .spo file, as docs/file-formats.md lists them,
 * written down a second time: it shares no code with our reader, so that what we write is checked
 * against the rules and not against ourselves. Used by tests only.
 */
#ifndef GMAT_SPO_RULES_H
#define GMAT_SPO_RULES_H

#include <stddef.h>

/* NULL when GMAT would take the file; else the first rule that it breaks, with its line. The text
 * is overwritten by the next call. `text` is terminated. */
const char *gmat_spo_broken_rule(const char *text);

#endif
