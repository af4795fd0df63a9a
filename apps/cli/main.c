/* SPDX-License-Identifier: Apache-2.0 */
/* srp: the command line of srpcore. */
#include "commands.h"
#include "completion.h"
#include "help.h"
#include "manual.h"
#include "messages.h"
#include "suggest.h"
#include "system.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const cli_command *const COMMANDS[] = {
    &cli_command_info,      &cli_command_force,   &cli_command_table,
    &cli_command_reoptic,   &cli_command_convert, &cli_command_plot,
    &cli_command_picture,   &cli_command_compare, &cli_command_fit_nplate,
#ifdef SRP_CLI_HAS_ORBIT
    &cli_command_propagate,
#endif
    &cli_command_cache,
};

const cli_command *const *cli_command_list(size_t *count) {
    *count = sizeof COMMANDS / sizeof COMMANDS[0];
    return COMMANDS;
}

const cli_command *cli_command_find(const char *name) {
    for (size_t i = 0; i < sizeof COMMANDS / sizeof COMMANDS[0]; ++i) {
        if (strcmp(COMMANDS[i]->name, name) == 0) {
            return COMMANDS[i];
        }
    }
    return NULL;
}

static int unknown_command(const char *name) {
    if (name[0] == '-') {
        return cli_usage_error("unknown option '%s'; options follow a command", name);
    }
    cli_suggestion near = cli_suggestion_begin(name);
    for (size_t i = 0; i < sizeof COMMANDS / sizeof COMMANDS[0]; ++i) {
        cli_suggestion_offer(&near, COMMANDS[i]->name);
    }
    cli_suggestion_offer(&near, "help");
    if (near.best != NULL) {
        return cli_usage_error("unknown command '%s', did you mean '%s'?", name, near.best);
    }
    return cli_usage_error("unknown command '%s'", name);
}

/* srp help [COMMAND | --man | --completion]; the last two serve the build. */
static int help(const char *topic) {
    if (topic == NULL || strcmp(topic, "--help") == 0 || strcmp(topic, "help") == 0) {
        cli_help_program(stdout);
    } else if (strcmp(topic, "--man") == 0) {
        cli_manual_write(stdout);
    } else if (strcmp(topic, "--completion") == 0) {
        cli_completion_write(stdout);
    } else {
        const cli_command *command = cli_command_find(topic);
        if (command == NULL) {
            return unknown_command(topic);
        }
        cli_help_command(stdout, command);
    }
    return CLI_DONE;
}

static int dispatch(int argc, char **argv) {
    if (argc < 2) {
        cli_usage_error("no command given");
        return CLI_BAD_USAGE;
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        return help(NULL);
    }
    if (strcmp(name, "help") == 0) {
        return help(argc > 2 ? argv[2] : NULL);
    }
    if (strcmp(name, "--version") == 0) {
        cli_help_version(stdout);
        return CLI_DONE;
    }
    const cli_command *command = cli_command_find(name);
    if (command == NULL) {
        return unknown_command(name);
    }
    char program[64];
    snprintf(program, sizeof program, "srp %s", name);
    cli_messages_begin(program);
    int status = command->run(command, argc - 1, argv + 1);
    cli_messages_begin("srp");
    return status;
}

int main(int argc, char **argv) {
    cli_system_begin();
    int status = dispatch(argc, argv);
    /* Results that did not reach the disk are not results. */
    errno = 0;
    if (ferror(stdout) || fclose(stdout) != 0) {
        cli_say("cannot write to standard output%s%s", errno != 0 ? ": " : "",
                errno != 0 ? strerror(errno) : "");
        return status == CLI_DONE ? CLI_MACHINE_FAILED : status;
    }
    return status;
}
