/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SRP_VIEWER_REOPTIC_H
#define SRP_VIEWER_REOPTIC_H

#include "viewer.h"

/* Makes, from the table shown, one of the optics that the materials have now, as `srp reoptic`
 * does; it joins the session's tables. */
void viewer_reoptic_request(viewer *v);
void viewer_reoptic_cancel(viewer *v);

#endif
