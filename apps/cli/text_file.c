/* SPDX-License-Identifier: Apache-2.0 */
#include "text_file.h"

#include "command.h"
#include "messages.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static int cannot_write(const char *path) {
    cli_say_of_file("%s: cannot write: %s", path, errno != 0 ? strerror(errno) : "unknown error");
    return CLI_MACHINE_FAILED;
}

char *cli_part_name(const char *path) {
    static const char ending[] = ".part";
    size_t length = strlen(path);
    char *name = malloc(length + sizeof ending);
    if (name != NULL) {
        memcpy(name, path, length);
        memcpy(name + length, ending, sizeof ending);
    }
    return name;
}

int cli_part_rename(const char *part, const char *path) {
    errno = 0;
    if (rename(part, path) == 0) {
        return CLI_DONE;
    }
    int status = cannot_write(path);
    remove(part);
    return status;
}

int cli_text_file_begin(cli_text_file *file, const char *path) {
    file->path = path;
    file->part = cli_part_name(path);
    if (file->part == NULL) {
        cli_say("no memory");
        return CLI_MACHINE_FAILED;
    }
    errno = 0;
    file->out = fopen(file->part, "w");
    if (file->out == NULL) {
        int status = cannot_write(path);
        free(file->part);
        return status;
    }
    return CLI_DONE;
}

int cli_text_file_end(cli_text_file *file) {
    errno = 0;
    int failed = ferror(file->out);
    int status = CLI_DONE;
    if (fclose(file->out) != 0 || failed != 0) {
        status = cannot_write(file->path);
        remove(file->part);
    } else {
        status = cli_part_rename(file->part, file->path);
    }
    free(file->part);
    return status;
}

void cli_text_file_drop(cli_text_file *file) {
    (void)fclose(file->out);
    remove(file->part);
    free(file->part);
}
