/* SPDX-License-Identifier: Apache-2.0 */
/* Everything that a user can do, by name: buttons, sliders, keys, menus and scripts all come
 * through here. docs/user-guide.md, "The viewer", lists them. */
#ifndef SRP_VIEWER_ACTIONS_H
#define SRP_VIEWER_ACTIONS_H

#include "viewer.h"

void viewer_actions_add(viewer *v);

/* LOOKS: looks at things, or asks for more: what was said of the last action stands. */
typedef enum viewer_action_kind { DOES, LOOKS } viewer_action_kind;

typedef struct viewer_action {
    const char *name;
    const char *type; /* of the parameter, as GVariant writes it; NULL: none */
    const char *keys; /* accelerators, separated by blanks; NULL: none */
    const char *help;
    void (*run)(viewer *v, GVariant *parameter);
    viewer_action_kind kind;
} viewer_action;

/* All of them; *count of them. */
const viewer_action *viewer_action_list(size_t *count);

#endif
