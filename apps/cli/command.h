/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a subcommand is: a constant table of options from which the parser, --help, the man page and
 * the completion of bash are all made, and a function that runs it.
 */
#ifndef SRP_CLI_COMMAND_H
#define SRP_CLI_COMMAND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Exit statuses. An interrupted run ends by its signal. */
typedef enum cli_exit {
    CLI_DONE = 0,
    CLI_BAD_INPUT = 1,
    CLI_BAD_USAGE = 2,
    CLI_MACHINE_FAILED = 3
} cli_exit;

/* Which options of a group were given, one bit per place in its table. First member of every struct
 * that a group of options is read into. */
typedef uint64_t cli_given;

/* What a number may be. */
typedef struct cli_range {
    double min, max;
    const char *words; /* "a number above 0": what a message says was expected */
} cli_range;

extern const cli_range CLI_POSITIVE, CLI_NOT_NEGATIVE;

/* Values that are given once per mention of an option, in order. Items point into argv. */
typedef struct cli_list {
    const char **items;
    size_t count;
} cli_list;

/* What completion offers behind an option. */
typedef enum cli_complete {
    CLI_COMPLETE_NOTHING,
    CLI_COMPLETE_FILE,
    CLI_COMPLETE_WORDS,
    CLI_COMPLETE_METHODS /* the names of srp_method_list() */
} cli_complete;

typedef struct cli_option cli_option;
struct cli_option {
    const char *name;      /* long name, without the dashes */
    char letter;           /* short name, 0 = none */
    const char *value;     /* how help calls the value, NULL = takes none */
    cli_complete complete; /* of the value */
    const char *words;     /* with CLI_COMPLETE_WORDS: the words, separated by blanks */
    const char *help;      /* one or two sentences */
    /* Reads `text` into the field at `offset` of `target`; on a wrong value says so and returns
     * false. */
    bool (*set)(const cli_option *option, void *target, const char *text);
    size_t offset;
    const cli_range *range; /* of numbers */
};

typedef struct cli_group {
    const char *title;
    const cli_option *options;
    size_t count; /* at most 64 */
} cli_group;

typedef struct cli_command cli_command;
struct cli_command {
    const char *name;
    const char *operands;      /* as the usage line shows them */
    const char *operand_files; /* completion: endings of file names, separated by blanks; "" any */
    const char *operand_words; /* completion: words instead of files; NULL: files */
    const char *summary;       /* one line */
    const char *description;   /* paragraphs, separated by "\n\n" */
    const char *examples;      /* command lines, separated by "\n" */
    const cli_group *const *groups;
    size_t group_count;
    int (*run)(const cli_command *command, int argc, char **argv);
};

/* All of them, in the order of help; *count of them. */
const cli_command *const *cli_command_list(size_t *count);
/* NULL when there is none of this name. */
const cli_command *cli_command_find(const char *name);

/* Options that every command has: --help, --version. */
extern const cli_group cli_group_common;

typedef struct cli_operands {
    const char *const *items;
    size_t count;
} cli_operands;

/*
 * Reads the command line of `command`: argv[0] is its name. targets[i] (starting with a cli_given)
 * takes the options of group i. True: go on. False: *exit_status says how to end; what had to be
 * said has been said.
 */
bool cli_command_parse(const cli_command *command, int argc, char **argv, void *const *targets,
                       cli_operands *operands, int *exit_status);

static inline bool cli_is_given(cli_given given, int option) {
    return (given >> option & 1u) != 0;
}

/* Setters for option tables. */
bool cli_set_flag(const cli_option *option, void *target, const char *text); /* bool */
bool cli_set_text(const cli_option *option, void *target, const char *text); /* const char * */
/* const char *, in UTF-8: formats of tables hold nothing else. */
bool cli_set_title(const cli_option *option, void *target, const char *text);
bool cli_set_number(const cli_option *option, void *target, const char *text); /* double */
bool cli_set_count(const cli_option *option, void *target, const char *text);  /* uint32_t */
bool cli_set_bits(const cli_option *option, void *target, const char *text);   /* uint64_t */
bool cli_set_vector(const cli_option *option, void *target, const char *text); /* srp_vec3 */
bool cli_set_window(const cli_option *option, void *target, const char *text); /* double[4] */
bool cli_set_list(const cli_option *option, void *target, const char *text);   /* cli_list */

void cli_list_free(cli_list *list);

#endif
