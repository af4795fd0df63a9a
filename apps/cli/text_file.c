/* SPDX-License-Identifier: Apache-2.0 */
#include "text_file.h"

#include "command.h"
#include "messages.h"
#include "system.h"

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

static void free_names(cli_text_file *file) {
    free(file->target);
    free(file->part);
}

int cli_text_file_begin(cli_text_file *file, const char *path) {
    bool special;
    *file = (cli_text_file){.path = path, .target = cli_system_write_target(path, &special)};
    if (file->target != NULL && !special) {
        file->part = cli_part_name(file->target);
    }
    if (file->target == NULL || (file->part == NULL && !special)) {
        cli_say("no memory");
        free_names(file);
        return CLI_MACHINE_FAILED;
    }
    errno = 0;
    file->out = fopen(special ? file->target : file->part, "w");
    if (file->out == NULL) {
        int status = cannot_write(path);
        free_names(file);
        return status;
    }
    return CLI_DONE;
}

int cli_text_file_end(cli_text_file *file) {
    int earlier = errno; /* of the write that failed, if one has */
    errno = 0;
    int failed = ferror(file->out);
    int status = CLI_DONE;
    if (fclose(file->out) != 0 || failed != 0) {
        errno = errno != 0 ? errno : earlier;
        status = cannot_write(file->path);
        if (file->part != NULL) {
            remove(file->part);
        }
    } else if (file->part != NULL) {
        status = cli_part_rename(file->part, file->target);
    }
    free_names(file);
    return status;
}

void cli_text_file_drop(cli_text_file *file) {
    (void)fclose(file->out);
    if (file->part != NULL) {
        remove(file->part);
    }
    free_names(file);
}
