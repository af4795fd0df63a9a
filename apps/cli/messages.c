/* SPDX-License-Identifier: Apache-2.0 */
#include "messages.h"

#include <stdarg.h>
#include <stdio.h>

static const char *program_name = "srp";

enum { TEXT_SIZE = 2048 }; /* file name, place and message of an srp_error, and more */

static _Thread_local cli_message_taker taker;
static _Thread_local void *taker_user;

void cli_messages_begin(const char *program) {
    program_name = program;
}

void cli_messages_to(cli_message_taker take, void *user) {
    taker = take;
    taker_user = user;
}

static void say(const char *prefix, const char *format, va_list arguments) {
    char text[TEXT_SIZE];
    vsnprintf(text, sizeof text, format, arguments);
    if (taker != NULL) {
        taker(taker_user, text);
        return;
    }
    fflush(stdout);
    fprintf(stderr, "%s%s%s\n", prefix, prefix[0] != '\0' ? ": " : "", text);
}

void cli_say(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(program_name, format, arguments);
    va_end(arguments);
}

void cli_say_of_file(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say("", format, arguments);
    va_end(arguments);
}

int cli_usage_error(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(program_name, format, arguments);
    va_end(arguments);
    if (taker == NULL) {
        fprintf(stderr, "Try '%s --help' for more information.\n", program_name);
    }
    return CLI_BAD_USAGE;
}

bool cli_reject(const cli_option *option, const char *text, const char *expected) {
    cli_usage_error("--%s %s: expected %s", option->name, text[0] != '\0' ? text : "''", expected);
    return false;
}

/* The option that would help; a window has none. */
static const char *remedy(const srp_error *error) {
    static const char *const WORDS[] = {
        [SRP_REMEDY_NONE] = "",
        [SRP_REMEDY_OPTICS] = " or as --material NAME=RHO_S,RHO_D",
        [SRP_REMEDY_MASS] = " (--mass KG)",
        [SRP_REMEDY_BASIS] = " (--basis)",
        [SRP_REMEDY_KEEP_BOUNCE] = " (--keep-bounce)",
    };
    return taker == NULL ? WORDS[error->remedy] : "";
}

static void print_error(const srp_error *error) {
    char text[TEXT_SIZE];
    size_t size = srp_error_format(error, text, sizeof text);
    if (size < sizeof text) {
        snprintf(text + size, sizeof text - size, "%s", remedy(error));
    }
    if (error->file[0] == '\0') {
        cli_say("%s", text);
    } else {
        cli_say_of_file("%s", text);
    }
}

int cli_input_error(const srp_error *error) {
    print_error(error);
    switch (error->status) {
    case SRP_BAD_ARGUMENT:
    case SRP_UNSUPPORTED:
        return CLI_BAD_USAGE;
    case SRP_NO_MEMORY:
    case SRP_NO_DEVICE:
        return CLI_MACHINE_FAILED;
    default:
        return CLI_BAD_INPUT; /* a file that cannot be read is wrong input, too */
    }
}

int cli_output_error(const srp_error *error) {
    print_error(error);
    switch (error->status) {
    case SRP_BAD_ARGUMENT:
    case SRP_UNSUPPORTED:
        return CLI_BAD_USAGE;
    default:
        return CLI_MACHINE_FAILED;
    }
}

static void warn(void *user, const srp_error *what) {
    (void)user;
    srp_error place = *what;
    snprintf(place.message, sizeof place.message, "warning: %.750s", what->message);
    print_error(&place);
}

srp_log cli_log(void) {
    srp_log log = {warn, NULL};
    return log;
}
