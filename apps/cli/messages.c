/* SPDX-License-Identifier: Apache-2.0 */
#include "messages.h"

#include <stdarg.h>
#include <stdio.h>

static const char *program_name = "srp";

void cli_messages_begin(const char *program) {
    program_name = program;
}

static void say(const char *format, va_list arguments) {
    fflush(stdout);
    fprintf(stderr, "%s: ", program_name);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
}

void cli_say(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
}

int cli_usage_error(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    fprintf(stderr, "Try '%s --help' for more information.\n", program_name);
    return CLI_BAD_USAGE;
}

bool cli_reject(const cli_option *option, const char *text, const char *expected) {
    cli_usage_error("--%s %s: expected %s", option->name, text[0] != '\0' ? text : "''", expected);
    return false;
}

enum { TEXT_SIZE = 1536 }; /* file name, place and message of an srp_error */

static void print_error(const srp_error *error) {
    char text[TEXT_SIZE];
    srp_error_format(error, text, sizeof text);
    if (error->file[0] == '\0') {
        cli_say("%s", text);
    } else {
        fflush(stdout);
        fprintf(stderr, "%s\n", text);
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
