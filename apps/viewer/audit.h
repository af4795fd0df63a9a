/* SPDX-License-Identifier: Apache-2.0 */
/* What a user without a mouse or a screen would miss in the window. */
#ifndef SRP_VIEWER_AUDIT_H
#define SRP_VIEWER_AUDIT_H

#include "viewer.h"

/*
 * Prints the least size of the window, and a line for each control that has no name for a screen
 * reader, that the Tab key does not reach, or whose mnemonic another one beside it has, and for
 * what is out of sight or whose words are cut. The names that were set are known under
 * GTK_A11Y=test alone. The count of complaints.
 */
int viewer_audit(viewer *v);

#endif
