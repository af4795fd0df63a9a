/* SPDX-License-Identifier: Apache-2.0 */
#include "help.h"

#include "methods.h"
#include "plate_fit.h"

#include <srp/table.h>

#include <string.h>

enum { HELP_COLUMN = 28, NAME_COLUMN = 14 };

static void pad(FILE *out, int count) {
    for (int i = 0; i < count; ++i) {
        fputc(' ', out);
    }
}

void cli_help_wrap(FILE *out, const char *text, int column, int indent) {
    bool first = true;
    while (*text != '\0') {
        if (strncmp(text, "\n\n", 2) == 0) {
            fputs("\n\n", out);
            pad(out, indent);
            text += 2;
            column = indent;
            first = true;
            continue;
        }
        int word = (int)strcspn(text, " \n");
        if (!first && column + 1 + word > CLI_HELP_WIDTH) {
            fputc('\n', out);
            pad(out, indent);
            column = indent;
        } else if (!first) {
            fputc(' ', out);
            ++column;
        }
        fwrite(text, 1, (size_t)word, out);
        column += word;
        first = false;
        text += word;
        text += *text == ' ';
    }
    fputc('\n', out);
}

void cli_help_version(FILE *out) {
    fputs("srp " SRP_VERSION "\n"
          "Copyright the srpcore authors. Licence Apache-2.0: "
          "<https://www.apache.org/licenses/LICENSE-2.0>.\n",
          out);
    if (cli_plate_fit_exists()) {
        fputs("This program is linked with GSL and as a whole handed on under GPL-3.\n", out);
    }
}

static void print_option(FILE *out, const cli_option *option) {
    int column = 0;
    if (option->letter != 0) {
        column += fprintf(out, "  -%c, ", option->letter);
    } else {
        column += fprintf(out, "      ");
    }
    column += fprintf(out, "--%s", option->name);
    if (option->value != NULL) {
        column += fprintf(out, "=%s", option->value);
    }
    if (column + 2 > HELP_COLUMN) {
        fputc('\n', out);
        column = 0;
    }
    pad(out, HELP_COLUMN - column);
    cli_help_wrap(out, option->help, HELP_COLUMN, HELP_COLUMN);
}

static void print_group(FILE *out, const cli_group *group) {
    fprintf(out, "\n%s:\n", group->title);
    for (size_t i = 0; i < group->count; ++i) {
        print_option(out, &group->options[i]);
    }
}

static void print_named(FILE *out, const char *name, const char *summary) {
    int column = fprintf(out, "  %s", name);
    pad(out, column < NAME_COLUMN ? NAME_COLUMN - column : 1);
    cli_help_wrap(out, summary, column < NAME_COLUMN ? NAME_COLUMN : column + 1, NAME_COLUMN);
}

/* True when the command takes the option --name. */
static bool takes(const cli_command *command, const char *name) {
    for (size_t g = 0; g < command->group_count; ++g) {
        for (size_t i = 0; i < command->groups[g]->count; ++i) {
            if (strcmp(command->groups[g]->options[i].name, name) == 0) {
                return true;
            }
        }
    }
    return false;
}

static void print_methods(FILE *out) {
    const srp_method *method;
    fputs("\nMethods:\n", out);
    for (size_t i = 0; (method = cli_method_named_at(i)) != NULL; ++i) {
        print_named(out, method->name, method->summary);
    }
}

static void print_formats(FILE *out) {
    size_t count;
    const srp_table_format *const *formats = srp_table_format_list(&count);
    fputs("\nFormats of tables, by the ending of the file:\n", out);
    for (size_t i = 0; i < count; ++i) {
        print_named(out, formats[i]->ending, formats[i]->summary);
    }
}

void cli_help_command(FILE *out, const cli_command *command) {
    fprintf(out, "Usage: srp %s [OPTION]...%s%s\n", command->name,
            command->operands[0] != '\0' ? " " : "", command->operands);
    cli_help_wrap(out, command->description, 0, 0);
    for (size_t i = 0; i < command->group_count; ++i) {
        print_group(out, command->groups[i]);
    }
    print_group(out, &cli_group_common);
    if (takes(command, "method")) {
        print_methods(out);
    }
    if (takes(command, "title") && !takes(command, "light")) {
        print_formats(out);
    }
    fputs("\nExamples:\n", out);
    for (const char *line = command->examples; *line != '\0';) {
        int length = (int)strcspn(line, "\n");
        fprintf(out, "  %.*s\n", length, line);
        line += length + (line[length] == '\n');
    }
}

void cli_help_program(FILE *out) {
    fputs("Usage: srp COMMAND [OPTION]... [FILE]...\n", out);
    cli_help_wrap(out,
                  "Solar radiation pressure on a spacecraft: from its shape and its optics to "
                  "forces and moments, for one direction of the Sun or for a whole table.",
                  0, 0);
    fputs("\nCommands:\n", out);
    size_t count;
    const cli_command *const *commands = cli_command_list(&count);
    for (size_t i = 0; i < count; ++i) {
        print_named(out, commands[i]->name, commands[i]->summary);
    }
    print_group(out, &cli_group_common);
    fputs("\nExit status:\n", out);
    print_named(out, "0", "done");
    print_named(out, "1", "the input is wrong");
    print_named(out, "2", "the usage is wrong");
    print_named(out, "3", "the machine failed: no memory, disk full, file not writable");
    fputs("\n'srp COMMAND --help' tells more about a command.\n", out);
}
