/* SPDX-License-Identifier: Apache-2.0 */
/* The methods of all libraries that this program is made of, and the devices that they run on. */
#ifndef SRP_CLI_METHODS_H
#define SRP_CLI_METHODS_H

#include <srp/method.h>

#include <stdbool.h>
#include <stddef.h>

/* The k-th method on any device; NULL behind the last. */
const srp_method *cli_method_at(size_t k);

/* The method of this name on a device, as --device takes it; NULL: none. */
const srp_method *cli_method_find(const char *name, const char *device);

/* The k-th method as far as users choose it by name: one of each name; NULL behind the last. */
const srp_method *cli_method_named_at(size_t k);

/* The device that `text` (of --device) means: "gl" is short for the one that needs no GPU. */
const char *cli_device_of(const char *text);

/* Whether `text` asks for a device of OpenGL, and this program is without OpenGL. */
bool cli_device_is_left_out(const char *text);

/* What --device takes, for help texts and completion. */
extern const char cli_device_words[], cli_device_help[];

#endif
