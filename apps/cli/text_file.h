/* SPDX-License-Identifier: Apache-2.0 */
/* Files that appear whole or not at all. */
#ifndef SRP_CLI_TEXT_FILE_H
#define SRP_CLI_TEXT_FILE_H

#include <stdio.h>

typedef struct cli_text_file {
    FILE *out;
    const char *path;
    char *target; /* where it goes: `path`, or what that is a link to */
    char *part;   /* what is written to meanwhile; NULL: the target itself, a device or a pipe */
} cli_text_file;

/* A file beside `path` to write to; `path` itself if it is a device or a pipe. An exit status, said
 * if not CLI_DONE. */
int cli_text_file_begin(cli_text_file *file, const char *path);
/* Gives the file its name, or removes it when something could not be written. An exit status, said
 * if not CLI_DONE. */
int cli_text_file_end(cli_text_file *file);
/* Gives it up: nothing is left of it. */
void cli_text_file_drop(cli_text_file *file);

/* The name that a file has until it is whole; freed by the caller. NULL without memory. */
char *cli_part_name(const char *path);
/* Gives the finished file `part` the name `path`. An exit status, said if not CLI_DONE. */
int cli_part_rename(const char *part, const char *path);

#endif
