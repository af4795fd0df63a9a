/* SPDX-License-Identifier: Apache-2.0 */
#include "completion.h"

#include "command.h"
#include "methods.h"

#include <stdbool.h>

/* Calls `visit` for every option of `command`. */
static void each_option(const cli_command *command,
                        void (*visit)(FILE *out, const cli_option *option), FILE *out) {
    for (size_t g = 0; g <= command->group_count; ++g) {
        const cli_group *group = g < command->group_count ? command->groups[g] : &cli_group_common;
        for (size_t i = 0; i < group->count; ++i) {
            visit(out, &group->options[i]);
        }
    }
}

static void put_name(FILE *out, const cli_option *option) {
    fprintf(out, " --%s", option->name);
}

static void put_methods(FILE *out) {
    const srp_method *method;
    fputs(") _srp_words '", out);
    for (size_t i = 0; (method = cli_method_named_at(i)) != NULL; ++i) {
        fprintf(out, "%s%s", i > 0 ? " " : "", method->name);
    }
    fputs("'; return ;;\n", out);
}

/* A branch of the case on the word before: what its value may be. */
static void put_values(FILE *out, const cli_option *option) {
    if (option->value == NULL) {
        return;
    }
    fprintf(out, "            --%s", option->name);
    if (option->letter != 0) {
        fprintf(out, " | -%c", option->letter);
    }
    switch (option->complete) {
    case CLI_COMPLETE_FILE:
        fputs(") _srp_files ''; return ;;\n", out);
        break;
    case CLI_COMPLETE_WORDS:
        fprintf(out, ") _srp_words '%s'; return ;;\n", option->words);
        break;
    case CLI_COMPLETE_METHODS:
        put_methods(out);
        break;
    case CLI_COMPLETE_NOTHING:
        fputs(") return ;;\n", out);
        break;
    }
}

static void put_case(FILE *out, const cli_command *command) {
    fprintf(out, "    %s)\n        case $before in\n", command->name);
    each_option(command, put_values, out);
    fputs("        esac\n        options='", out);
    each_option(command, put_name, out);
    if (command->operand_words != NULL) {
        fprintf(out, "'\n        operands='%s'\n        ;;\n", command->operand_words);
    } else {
        fprintf(out, "'\n        endings='%s'\n        ;;\n", command->operand_files);
    }
}

static const char COMPLETION_HEAD[] =
    "# bash completion for srp                                   -*- shell-script -*-\n"
    "# SPDX-License-Identifier: Apache-2.0\n"
    "# Made by 'srp help --completion' from the tables of options.\n"
    "\n"
    "# Words of $1 that begin as the current word does.\n"
    "_srp_words() {\n"
    "    mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$word\")\n"
    "}\n"
    "\n"
    "# Directories, and files with one of the endings in $1 (any when there is none).\n"
    "_srp_files() {\n"
    "    local ending\n"
    "    compopt -o filenames 2> /dev/null\n"
    "    mapfile -t COMPREPLY < <({\n"
    "        compgen -d -- \"$word\"\n"
    "        if [ -z \"$1\" ]; then\n"
    "            compgen -f -- \"$word\"\n"
    "        fi\n"
    "        for ending in $1; do\n"
    "            compgen -f -X \"!*.$ending\" -- \"$word\"\n"
    "        done\n"
    "    } | sort -u)\n"
    "}\n"
    "\n"
    "_srp() {\n"
    "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
    "    local options endings operands=\n"
    "    COMPREPLY=()\n"
    "    # bash takes '=' as a word of its own: --method=ex is three words.\n"
    "    if [ \"$word\" = = ]; then\n"
    "        word=\n"
    "    elif [ \"$before\" = = ] && [ \"$COMP_CWORD\" -gt 2 ]; then\n"
    "        before=${COMP_WORDS[COMP_CWORD - 2]}\n"
    "    fi\n"
    "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n";

static const char COMPLETION_TAIL[] = "    *)\n"
                                      "        return\n"
                                      "        ;;\n"
                                      "    esac\n"
                                      "    case $word in\n"
                                      "    -*) _srp_words \"$options\" ;;\n"
                                      "    *)\n"
                                      "        if [ -n \"$operands\" ]; then\n"
                                      "            _srp_words \"$operands\"\n"
                                      "        else\n"
                                      "            _srp_files \"$endings\"\n"
                                      "        fi\n"
                                      "        ;;\n"
                                      "    esac\n"
                                      "}\n"
                                      "\n"
                                      "complete -F _srp srp\n";

void cli_completion_write(FILE *out) {
    size_t count;
    const cli_command *const *commands = cli_command_list(&count);
    fputs(COMPLETION_HEAD, out);
    fputs("        _srp_words '", out);
    for (size_t i = 0; i < count; ++i) {
        fprintf(out, "%s ", commands[i]->name);
    }
    fputs("help --help --version'\n        return\n    fi\n    case ${COMP_WORDS[1]} in\n"
          "    help)\n        _srp_words '",
          out);
    for (size_t i = 0; i < count; ++i) {
        fprintf(out, "%s%s", i > 0 ? " " : "", commands[i]->name);
    }
    fputs("'\n        return\n        ;;\n", out);
    for (size_t i = 0; i < count; ++i) {
        put_case(out, commands[i]);
    }
    fputs(COMPLETION_TAIL, out);
}
