/* SPDX-License-Identifier: Apache-2.0 */
#include "command.h"

#include "help.h"
#include "messages.h"
#include "suggest.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_HELP, OPTION_VERSION, COMMON_COUNT };

typedef struct common_options {
    cli_given given;
    bool help, version;
} common_options;

static const cli_option COMMON[COMMON_COUNT] = {
    [OPTION_HELP] = {.name = "help",
                     .letter = 'h',
                     .help = "Show this help and exit.",
                     .set = cli_set_flag,
                     .offset = offsetof(common_options, help)},
    [OPTION_VERSION] = {.name = "version",
                        .help = "Show the version and exit.",
                        .set = cli_set_flag,
                        .offset = offsetof(common_options, version)},
};

const cli_group cli_group_common = {"Other options", COMMON, COMMON_COUNT};

/* ---- parsing ---- */

enum { OPTIONS_MAX = 64, LONG_BASE = 256 }; /* of one command; values of long options from there */

/* All options of one command side by side, as getopt_long() wants them. */
typedef struct parser {
    const cli_option *option[OPTIONS_MAX];
    void *target[OPTIONS_MAX];
    unsigned bit[OPTIONS_MAX];
    size_t count;
    struct option longs[OPTIONS_MAX + 1];
    char shorts[2 * OPTIONS_MAX + 2];
} parser;

static void add_group(parser *p, const cli_group *group, void *target) {
    size_t used = strlen(p->shorts);
    for (size_t i = 0; i < group->count && p->count < OPTIONS_MAX; ++i) {
        const cli_option *option = &group->options[i];
        size_t k = p->count++;
        p->option[k] = option;
        p->target[k] = target;
        p->bit[k] = (unsigned)i;
        p->longs[k].name = option->name;
        p->longs[k].has_arg = option->value != NULL ? required_argument : no_argument;
        p->longs[k].val = LONG_BASE + (int)k;
        if (option->letter != 0) {
            p->shorts[used++] = option->letter;
            if (option->value != NULL) {
                p->shorts[used++] = ':';
            }
        }
    }
}

/* Place of the option that getopt_long() returned as `code`, p->count when it was none. */
static size_t place_of(const parser *p, int code) {
    if (code >= LONG_BASE) {
        return (size_t)(code - LONG_BASE);
    }
    size_t k = 0;
    while (k < p->count && p->option[k]->letter != code) {
        ++k;
    }
    return k;
}

/* Length of the name in `word`, "--name" or "--name=value"; 0 when it is no long option. */
static size_t long_name(const char *word, const char **name) {
    if (word[0] != '-' || word[1] != '-') {
        return 0;
    }
    *name = word + 2;
    return strcspn(word + 2, "=");
}

/* Is `word` the beginning of a long option only? getopt_long() takes that for the option, and then
 * a slip means something: --az of another command would be --az-step here. */
static bool is_abbreviated(const parser *p, const char *word) {
    const char *name;
    size_t length = long_name(word, &name);
    for (size_t k = 0; k < p->count && length > 0; ++k) {
        if (strncmp(p->option[k]->name, name, length) == 0 && p->option[k]->name[length] == '\0') {
            return false;
        }
    }
    return length > 0;
}

static void explain_unknown(const parser *p, const char *word) {
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    const char *beginning = NULL;
    size_t beginnings = 0;
    cli_suggestion near = cli_suggestion_begin(name);
    for (size_t k = 0; k < p->count; ++k) {
        if (strncmp(p->option[k]->name, name, strlen(name)) == 0) {
            beginning = p->option[k]->name;
            ++beginnings;
        }
        cli_suggestion_offer(&near, p->option[k]->name);
    }
    const char *meant = beginnings == 1 ? beginning : near.best;
    if (meant != NULL) {
        cli_usage_error("unknown option '--%s', did you mean '--%s'?", name, meant);
    } else {
        cli_usage_error("unknown option '--%s'", name);
    }
}

/* The option that getopt_long() stopped at, as the user wrote it. */
static void explain(const parser *p, int code, const char *word) {
    if (is_abbreviated(p, word)) {
        explain_unknown(p, word);
        return;
    }
    if (code == ':') {
        size_t k = place_of(p, optopt);
        cli_usage_error("%s needs a value: %s", word, p->option[k]->value);
        return;
    }
    if (optopt >= LONG_BASE) {
        cli_usage_error("--%s takes no value", p->option[optopt - LONG_BASE]->name);
        return;
    }
    if (optopt != 0) {
        cli_usage_error("unknown option '-%c'", optopt);
        return;
    }
    explain_unknown(p, word);
}

/* The later of two values would win without a word. A flag given twice means nothing else than
 * once, and lists are there to be added to. */
static bool is_repeated(const parser *p, size_t k) {
    const cli_option *option = p->option[k];
    if (!cli_is_given(*(const cli_given *)p->target[k], (int)p->bit[k]) || option->value == NULL ||
        option->set == cli_set_list) {
        return false;
    }
    if (option->letter != 0) {
        cli_usage_error("--%s (-%c) is given twice and takes one value", option->name,
                        option->letter);
    } else {
        cli_usage_error("--%s is given twice and takes one value", option->name);
    }
    return true;
}

static bool read_options(parser *p, int argc, char **argv) {
    opterr = 0;
    optind = 1;
    for (;;) {
        optopt = 0;
        int code = getopt_long(argc, argv, p->shorts, p->longs, NULL);
        if (code == -1) {
            return true;
        }
        if (code == '?' || code == ':') {
            explain(p, code, argv[optind - 1]);
            return false;
        }
        size_t k = place_of(p, code);
        /* The value is a word of its own, or part of the option's. */
        const char *word = argv[optind - (optarg != NULL && optarg == argv[optind - 1] ? 2 : 1)];
        if (code >= LONG_BASE && is_abbreviated(p, word)) {
            explain_unknown(p, word);
            return false;
        }
        if (is_repeated(p, k) || !p->option[k]->set(p->option[k], p->target[k], optarg)) {
            return false;
        }
        *(cli_given *)p->target[k] |= (cli_given)1 << p->bit[k];
    }
}

bool cli_command_parse(const cli_command *command, int argc, char **argv, void *const *targets,
                       cli_operands *operands, int *exit_status) {
    parser p;
    memset(&p, 0, sizeof p);
    p.shorts[0] = ':'; /* tells a missing value from an unknown option */
    common_options common = {0, false, false};
    for (size_t i = 0; i < command->group_count; ++i) {
        add_group(&p, command->groups[i], targets[i]);
    }
    add_group(&p, &cli_group_common, &common);
    bool good = read_options(&p, argc, argv);
    /* Asked for help among mistakes, give help. */
    if (common.help) {
        cli_help_command(stdout, command);
        *exit_status = CLI_DONE;
        return false;
    }
    if (!good) {
        *exit_status = CLI_BAD_USAGE;
        return false;
    }
    if (common.version) {
        cli_help_version(stdout);
        *exit_status = CLI_DONE;
        return false;
    }
    operands->items = (const char *const *)argv + optind;
    operands->count = (size_t)(argc - optind);
    for (size_t i = 0; i < operands->count; ++i) {
        if (operands->items[i][0] == '\0') {
            *exit_status =
                cli_usage_error("operand %zu is empty, expected the name of a file", i + 1);
            return false;
        }
    }
    return true;
}
