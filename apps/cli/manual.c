/* SPDX-License-Identifier: Apache-2.0 */
#include "manual.h"

#include "command.h"
#include "method_options.h"
#include "methods.h"

#include <srp/table.h>

#include <stdbool.h>
#include <string.h>

/* Text of a macro's argument or of a line: what roff would take as its own is masked. */
static void put_escaped(FILE *out, const char *text, size_t length) {
    for (size_t i = 0; i < length; ++i) {
        switch (text[i]) {
        case '\\':
            fputs("\\e", out);
            break;
        case '-':
            fputs("\\-", out);
            break;
        case '\'':
            fputs(i == 0 ? "\\&\\(aq" : "\\(aq", out);
            break;
        case '.':
            fputs(i == 0 ? "\\&." : ".", out);
            break;
        default:
            fputc(text[i], out);
        }
    }
}

static bool ends_sentence(const char *word, size_t length) {
    return length > 1 && strchr(".?!", word[length - 1]) != NULL;
}

enum { SOURCE_WIDTH = 72 }; /* of the lines of the source, before masking */

/* Running text: each sentence on a line of its own, as mdoc(7) asks; "\n\n" is a paragraph. */
static void put_text(FILE *out, const char *text) {
    bool line_begins = true;
    size_t column = 0;
    while (*text != '\0') {
        if (strncmp(text, "\n\n", 2) == 0) {
            fputs(line_begins ? ".Pp\n" : "\n.Pp\n", out);
            line_begins = true;
            text += 2;
            continue;
        }
        size_t length = strcspn(text, " \n");
        column = line_begins ? length : column + 1 + length;
        if (!line_begins && column > SOURCE_WIDTH) {
            fputc('\n', out);
            column = length;
            line_begins = true;
        }
        if (!line_begins) {
            fputc(' ', out);
        }
        put_escaped(out, text, length);
        line_begins = ends_sentence(text, length);
        if (line_begins) {
            fputc('\n', out);
        }
        text += length;
        text += *text == ' ';
    }
    if (!line_begins) {
        fputc('\n', out);
    }
}

static void put_option(FILE *out, const cli_option *option) {
    fputs(".It ", out);
    if (option->letter != 0) {
        fprintf(out, "Fl %c , ", option->letter);
    }
    fputs("Fl \\-", out);
    put_escaped(out, option->name, strlen(option->name));
    if (option->value != NULL) {
        fputs(" Ns = Ns Ar ", out);
        put_escaped(out, option->value, strlen(option->value));
    }
    fputc('\n', out);
    put_text(out, option->help);
}

static void put_options(FILE *out, const cli_group *group) {
    fputs(".Bl -tag -width Ds\n", out);
    for (size_t i = 0; i < group->count; ++i) {
        put_option(out, &group->options[i]);
    }
    fputs(".El\n", out);
}

/* Written once for all commands, in a section of its own. */
static bool is_shared(const cli_group *group) {
    return group == &cli_group_model || group == &cli_group_method;
}

static void put_command(FILE *out, const cli_command *command) {
    fprintf(out, ".Ss srp %s\n", command->name);
    fprintf(out, ".Nm Cm %s\n.Op Ar OPTION ...\n.Ar ", command->name);
    put_escaped(out, command->operands, strlen(command->operands));
    fputs("\n.Pp\n", out);
    put_text(out, command->description);
    for (size_t i = 0; i < command->group_count; ++i) {
        if (!is_shared(command->groups[i])) {
            put_options(out, command->groups[i]);
        }
    }
    for (size_t i = 0; i < command->group_count; ++i) {
        if (is_shared(command->groups[i])) {
            fprintf(out, ".Pp\nAlso the options of\n.Sx %s options .\n", command->groups[i]->title);
        }
    }
}

static void put_shared(FILE *out, const cli_group *group) {
    fprintf(out, ".Ss %s options\n", group->title);
    put_options(out, group);
}

static void put_item(FILE *out, const char *name, const char *text) {
    fputs(".It Cm ", out);
    put_escaped(out, name, strlen(name));
    fputc('\n', out);
    put_text(out, text);
}

static void put_lists(FILE *out) {
    const srp_method *method;
    fputs(".Sh METHODS\n.Bl -tag -width cannonball\n", out);
    for (size_t i = 0; (method = cli_method_named_at(i)) != NULL; ++i) {
        put_item(out, method->name, method->summary);
    }
    size_t count;
    const srp_table_format *const *formats = srp_table_format_list(&count);
    fputs(".El\n.Sh FILE FORMATS\nThe ending of a file chooses the format of a table.\n"
          ".Bl -tag -width Ds\n",
          out);
    for (size_t i = 0; i < count; ++i) {
        put_item(out, formats[i]->ending, formats[i]->summary);
    }
    fputs(".El\n", out);
}

static void put_examples(FILE *out, const cli_command *command) {
    for (const char *line = command->examples; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        fputs(".Dl ", out);
        put_escaped(out, line, length);
        fputc('\n', out);
        line += length + (line[length] == '\n');
    }
}

void cli_manual_write(FILE *out) {
    size_t count;
    const cli_command *const *commands = cli_command_list(&count);
    fputs(".\\\" SPDX-License-Identifier: Apache-2.0\n"
          ".\\\" Made by 'srp help --man' from the tables of options.\n"
          ".Dd " SRP_DATE "\n.Dt SRP 1\n.Os\n.Sh NAME\n.Nm srp\n"
          ".Nd solar radiation pressure on spacecraft\n.Sh SYNOPSIS\n",
          out);
    for (size_t i = 0; i < count; ++i) {
        fprintf(out, ".Nm\n.Cm %s\n.Op Ar OPTION ...\n.Ar ", commands[i]->name);
        put_escaped(out, commands[i]->operands, strlen(commands[i]->operands));
        fputc('\n', out);
    }
    fputs(".Nm\n.Cm help\n.Op Ar COMMAND\n.Sh DESCRIPTION\n.Nm\n"
          "computes the force and the moment of sunlight on a spacecraft from its\n"
          "shape and its optics.\n"
          "Results go to standard output, messages and progress to standard error.\n"
          "Names of options are written in full.\n.Sh COMMANDS\n",
          out);
    for (size_t i = 0; i < count; ++i) {
        put_command(out, commands[i]);
    }
    fputs(".Sh OPTIONS\n.Ss Common options\n", out);
    put_options(out, &cli_group_common);
    put_shared(out, &cli_group_model);
    put_shared(out, &cli_group_method);
    put_lists(out);
    fputs(".Sh EXIT STATUS\n.Bl -tag -width Ds\n"
          ".It 0\nDone.\n.It 1\nThe input is wrong.\n.It 2\nThe usage is wrong.\n"
          ".It 3\nThe machine failed: no memory, disk full, file not writable.\n.El\n.Pp\n"
          "An interrupted run ends by its signal.\n.Sh EXAMPLES\n",
          out);
    for (size_t i = 0; i < count; ++i) {
        put_examples(out, commands[i]);
    }
}
