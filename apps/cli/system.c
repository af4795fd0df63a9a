/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#define _DEFAULT_SOURCE /* TIOCGWINSZ */

#include "system.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

bool cli_system_stderr_is_terminal(void) {
    return isatty(STDERR_FILENO) == 1;
}

int cli_system_stderr_columns(void) {
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
        return size.ws_col;
    }
    return 80;
}

double cli_system_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void cli_system_begin(void) {
    signal(SIGXFSZ, SIG_IGN);
}

static volatile sig_atomic_t signal_seen;

static void keep_signal(int number) {
    signal_seen = number;
}

void cli_system_catch_signals(void) {
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        struct sigaction now, action;
        memset(&action, 0, sizeof action);
        action.sa_handler = keep_signal;
        /* Reset: a program that does not react can still be ended by a second Ctrl-C. Restart:
         * reads and writes of the library go on. */
        action.sa_flags = SA_RESTART | (int)SA_RESETHAND;
        sigemptyset(&action.sa_mask);
        /* What nohup(1) or a shell's background job has set to be ignored stays so. */
        if (sigaction(numbers[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN) {
            sigaction(numbers[i], &action, NULL);
        }
    }
}

int cli_system_signal_seen(void) {
    return (int)signal_seen;
}

void cli_system_die_by_signal(int signal_number) {
    fflush(stdout);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

/* Directory part of `path`; freed by the caller, NULL without memory. */
static char *directory_of(const char *path) {
    const char *slash = strrchr(path, '/');
    size_t length = slash == NULL ? 1 : slash == path ? 1 : (size_t)(slash - path);
    char *directory = malloc(length + 1);
    if (directory != NULL) {
        memcpy(directory, slash == NULL ? "." : path, length);
        directory[length] = '\0';
    }
    return directory;
}

bool cli_system_can_write(const char *path, const char **reason) {
    struct stat about;
    bool exists = stat(path, &about) == 0;
    if (exists && S_ISDIR(about.st_mode)) {
        *reason = "is a directory, expected a file";
        return false;
    }
    if (exists && !S_ISREG(about.st_mode)) {
        *reason = access(path, W_OK) == 0 ? NULL : strerror(errno);
        return *reason == NULL;
    }
    /* The file is written beside the old one and takes its place: the directory must allow it. */
    char *directory = directory_of(path);
    if (directory == NULL) {
        *reason = "no memory";
        return false;
    }
    *reason = NULL;
    if (stat(directory, &about) != 0) {
        *reason = strerror(errno);
    } else if (!S_ISDIR(about.st_mode)) {
        *reason = strerror(ENOTDIR);
    } else if (access(directory, W_OK | X_OK) != 0) {
        *reason = strerror(errno);
    }
    free(directory);
    return *reason == NULL;
}

char *cli_system_write_target(const char *path, bool *special) {
    struct stat about;
    bool link = lstat(path, &about) == 0 && S_ISLNK(about.st_mode);
    bool exists = stat(path, &about) == 0;
    *special = exists ? !S_ISREG(about.st_mode) : link;
    return link && !*special ? realpath(path, NULL) : strdup(path);
}

bool cli_system_same_file(const char *a, const char *b) {
    struct stat first, second;
    return stat(a, &first) == 0 && stat(b, &second) == 0 && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}

static const char *base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

bool cli_system_same_name(const char *a, const char *b) {
    if (strcmp(a, b) == 0) {
        return true;
    }
    char *first = directory_of(a), *second = directory_of(b);
    bool same = first != NULL && second != NULL && strcmp(base_name(a), base_name(b)) == 0 &&
                cli_system_same_file(first, second);
    free(first);
    free(second);
    return same;
}

bool cli_system_file_exists(const char *path) {
    struct stat about;
    return stat(path, &about) == 0;
}
