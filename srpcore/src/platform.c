/* SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE /* sched_getaffinity, strerror_r, newlocale, madvise, RTLD_NODELETE */

#include "platform.h"

#include "error.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <pthread.h>
#include <sched.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

int srp_platform_processor_count(void) {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
        return CPU_COUNT(&set);
    }
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}

void *srp_platform_allocate_table(size_t size) {
    const size_t line = 64, large = (size_t)1 << 21;
    size_t alignment = size >= large ? large : line;
    if (size > SIZE_MAX - alignment) {
        return NULL;
    }
    size_t whole = (size + alignment - 1) / alignment * alignment;
    void *memory = aligned_alloc(alignment, whole);
    if (memory != NULL && alignment == large) {
        (void)madvise(memory, whole, MADV_HUGEPAGE); /* a wish */
    }
    return memory;
}

srp_platform_library *srp_platform_library_open(const char *const *names, char *reason,
                                                size_t size) {
    void *library = NULL;
    for (size_t i = 0; names[i] != NULL && library == NULL; ++i) {
        library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    }
    if (library == NULL) {
        const char *said = dlerror();
        (void)snprintf(reason, size, "%s", said != NULL ? said : "not found");
    }
    return library;
}

void srp_platform_library_close(srp_platform_library *library) {
    if (library != NULL) {
        (void)dlclose(library);
    }
}

srp_platform_function srp_platform_library_function(srp_platform_library *library,
                                                    const char *name) {
    /* POSIX lets dlsym() tell of functions as of data; ISO C knows no such cast. */
    void *symbol = dlsym(library, name);
    srp_platform_function function = NULL;
    if (symbol != NULL) {
        memcpy(&function, &symbol, sizeof function);
    }
    return function;
}

/* ---- Threads and time ----------------------------------------------------------------------- */

struct srp_platform_monitor {
    pthread_mutex_t lock;
    pthread_cond_t bell;
};

srp_platform_monitor *srp_platform_monitor_create(void) {
    srp_platform_monitor *monitor = malloc(sizeof *monitor);
    if (monitor == NULL) {
        return NULL;
    }
    if (pthread_mutex_init(&monitor->lock, NULL) != 0) {
        free(monitor);
        return NULL;
    }
    if (pthread_cond_init(&monitor->bell, NULL) != 0) {
        pthread_mutex_destroy(&monitor->lock);
        free(monitor);
        return NULL;
    }
    return monitor;
}

void srp_platform_monitor_destroy(srp_platform_monitor *monitor) {
    if (monitor != NULL) {
        pthread_cond_destroy(&monitor->bell);
        pthread_mutex_destroy(&monitor->lock);
        free(monitor);
    }
}

void srp_platform_monitor_enter(srp_platform_monitor *monitor) {
    pthread_mutex_lock(&monitor->lock);
}

void srp_platform_monitor_leave(srp_platform_monitor *monitor) {
    pthread_mutex_unlock(&monitor->lock);
}

void srp_platform_monitor_wait(srp_platform_monitor *monitor) {
    pthread_cond_wait(&monitor->bell, &monitor->lock);
}

void srp_platform_monitor_ring(srp_platform_monitor *monitor) {
    pthread_cond_broadcast(&monitor->bell);
}

/* Guards state that is not ours: that of NetCDF and HDF5, which are one per process. */
static pthread_mutex_t netcdf_lock = PTHREAD_MUTEX_INITIALIZER;

void srp_platform_netcdf_enter(void) {
    pthread_mutex_lock(&netcdf_lock);
}

void srp_platform_netcdf_leave(void) {
    pthread_mutex_unlock(&netcdf_lock);
}

double srp_platform_seconds(void) {
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- Numbers in text ------------------------------------------------------------------------ */

srp_c_locale srp_platform_c_locale_enter(void) {
    srp_c_locale state = {NULL, NULL};
    locale_t ours = newlocale(LC_NUMERIC_MASK, "C", duplocale(uselocale((locale_t)0)));
    if (ours != (locale_t)0) {
        state.ours = (void *)ours;
        state.previous = (void *)uselocale(ours);
    }
    return state;
}

void srp_platform_c_locale_leave(srp_c_locale state) {
    if (state.ours != NULL) {
        uselocale((locale_t)state.previous);
        freelocale((locale_t)state.ours);
    }
}

/* ---- Files ---------------------------------------------------------------------------------- */

srp_status srp_platform_fail_errno(srp_error *error, const char *path, const char *what) {
    int code = errno;
    char text[128];
    srp_status status = code == ENOENT ? SRP_NOT_FOUND : code == ENOMEM ? SRP_NO_MEMORY : SRP_IO;
    return srp_fail_at(error, status, path, 0, 0, "cannot %s: %s", what,
                       strerror_r(code, text, sizeof text));
}

/* One read(), tried again when a signal broke it off; *got is 0 at the end of the file. */
static srp_status read_piece(int file, const char *path, char *buffer, size_t room, size_t *got,
                             srp_error *error) {
    ssize_t count;
    do {
        count = read(file, buffer, room);
    } while (count < 0 && errno == EINTR);
    if (count < 0) {
        return srp_platform_fail_errno(error, path, "read");
    }
    *got = (size_t)count;
    return SRP_OK;
}

/* Reads to the end of `file`, growing the buffer: pipes and /proc have no size to ask for. */
static srp_status read_to_end(int file, const char *path, srp_platform_inspect inspect, void *user,
                              char **text, size_t *size, srp_error *error) {
    size_t capacity = 1 << 16, used = 0, got = 1;
    char *buffer = malloc(capacity);
    srp_status status = SRP_OK;
    while (buffer != NULL && status == SRP_OK && got > 0) {
        status = read_piece(file, path, buffer + used, capacity - used - 1, &got, error);
        if (status == SRP_OK) {
            status = inspect(user, buffer + used, got, error);
            used += got;
        }
        if (status == SRP_OK && used + 1 == capacity) {
            char *larger = capacity > SIZE_MAX / 2 ? NULL : realloc(buffer, capacity * 2);
            if (larger == NULL) {
                free(buffer);
            }
            buffer = larger;
            capacity *= 2;
        }
    }
    if (buffer == NULL) {
        return srp_fail_at(error, SRP_NO_MEMORY, path, 0, 0, "no memory to read the file");
    }
    if (status != SRP_OK) {
        free(buffer);
        return status;
    }
    buffer[used] = '\0';
    *text = buffer;
    *size = used;
    return SRP_OK;
}

srp_status srp_platform_read_file(const char *path, srp_platform_inspect inspect, void *user,
                                  char **text, size_t *size, srp_error *error) {
    int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) {
        return srp_platform_fail_errno(error, path, "open");
    }
    struct stat about;
    srp_status status;
    if (fstat(file, &about) == 0 && S_ISDIR(about.st_mode)) {
        status = srp_fail_at(error, SRP_IO, path, 0, 0, "is a directory, expected a file");
    } else {
        status = read_to_end(file, path, inspect, user, text, size, error);
    }
    close(file);
    return status;
}

static srp_status fail_write(srp_error *error, const char *path) {
    srp_status status = srp_platform_fail_errno(error, path, "write");
    /* A directory that is missing is, for a writer, the refusal of the system. */
    if (status == SRP_NOT_FOUND) {
        status = SRP_IO;
        if (error != NULL) {
            error->status = status;
        }
    }
    return status;
}

static srp_status draft_make(const char *target, bool special, srp_platform_draft *out,
                             srp_error *error) {
    size_t length = strlen(target);
    srp_platform_draft draft = {malloc(length + 32), malloc(length + 1)};
    if (draft.path == NULL || draft.target == NULL) {
        free(draft.path);
        free(draft.target);
        return srp_fail_at(error, SRP_NO_MEMORY, target, 0, 0, "no memory");
    }
    memcpy(draft.target, target, length + 1);
    if (special) {
        memcpy(draft.path, target, length + 1);
    } else {
        snprintf(draft.path, length + 32, "%s.%ld.tmp", target, (long)getpid());
        int file = open(draft.path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (file < 0) {
            srp_status status = fail_write(error, target);
            free(draft.path);
            free(draft.target);
            return status;
        }
        close(file);
    }
    *out = draft;
    return SRP_OK;
}

srp_status srp_platform_draft_begin(const char *target, srp_platform_draft *out, srp_error *error) {
    /* A device or a pipe (/dev/stdout, /dev/full) cannot be renamed over: write it directly. */
    struct stat about;
    bool special = stat(target, &about) == 0 && !S_ISREG(about.st_mode);
    if (special && S_ISDIR(about.st_mode)) {
        return srp_fail_at(error, SRP_IO, target, 0, 0, "is a directory, expected a file");
    }
    /* What a link points to is replaced, not the link. */
    char *real = NULL;
    if (!special && lstat(target, &about) == 0 && S_ISLNK(about.st_mode)) {
        real = realpath(target, NULL);
    }
    srp_status status = draft_make(real != NULL ? real : target, special, out, error);
    free(real);
    return status;
}

static void draft_free(srp_platform_draft *draft) {
    free(draft->path);
    free(draft->target);
    draft->path = NULL;
    draft->target = NULL;
}

srp_status srp_platform_draft_commit(srp_platform_draft *draft, srp_error *error) {
    if (strcmp(draft->path, draft->target) == 0) {
        draft_free(draft);
        return SRP_OK;
    }
    srp_status status = SRP_OK;
    int file = open(draft->path, O_WRONLY | O_CLOEXEC);
    if (file < 0 || fsync(file) != 0) {
        status = srp_platform_fail_errno(error, draft->target, "write");
    }
    if (file >= 0) {
        close(file);
    }
    if (status == SRP_OK && rename(draft->path, draft->target) != 0) {
        status = srp_platform_fail_errno(error, draft->target, "replace");
    }
    if (status != SRP_OK) {
        unlink(draft->path);
    }
    draft_free(draft);
    return status;
}

void srp_platform_draft_abandon(srp_platform_draft *draft) {
    if (draft->path != NULL && strcmp(draft->path, draft->target) != 0) {
        unlink(draft->path);
    }
    draft_free(draft);
}

/* Adds bytes to the end of a draft. */
static srp_status draft_append(const srp_platform_draft *draft, const char *bytes, size_t size,
                               srp_error *error) {
    int file = open(draft->path, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file < 0) {
        return fail_write(error, draft->target);
    }
    srp_status status = SRP_OK;
    for (size_t done = 0; status == SRP_OK && done < size;) {
        ssize_t put = write(file, bytes + done, size - done);
        if (put >= 0) {
            done += (size_t)put;
        } else if (errno != EINTR) {
            status = fail_write(error, draft->target);
        }
    }
    /* Some file systems tell of a full disk only here. */
    if (close(file) != 0 && status == SRP_OK) {
        status = fail_write(error, draft->target);
    }
    return status;
}

srp_status srp_platform_write_file(const char *path, const char *bytes, size_t size,
                                   srp_error *error) {
    srp_platform_draft draft;
    srp_status status = srp_platform_draft_begin(path, &draft, error);
    if (status != SRP_OK) {
        return status;
    }
    status = draft_append(&draft, bytes, size, error);
    if (status != SRP_OK) {
        srp_platform_draft_abandon(&draft);
        return status;
    }
    return srp_platform_draft_commit(&draft, error);
}

/* ---- The cache ------------------------------------------------------------------------------ */

srp_status srp_platform_cache_directory(const char *name, char **out, srp_error *error) {
    const char *home = getenv("XDG_CACHE_HOME"), *below = "";
    /* "All paths set in these environment variables must be absolute", says the specification. */
    if (home == NULL || home[0] != '/') {
        home = getenv("HOME");
        below = "/.cache";
    }
    if (home == NULL || home[0] != '/') {
        return srp_fail(error, SRP_NOT_FOUND,
                        "no directory for the cache: neither XDG_CACHE_HOME nor HOME is set");
    }
    size_t size = strlen(home) + strlen(below) + strlen(name) + 2;
    char *path = malloc(size);
    if (path == NULL) {
        return srp_fail(error, SRP_NO_MEMORY, "no memory for a path of %zu bytes", size);
    }
    snprintf(path, size, "%s%s/%s", home, below, name);
    *out = path;
    return SRP_OK;
}

srp_status srp_platform_make_directory(const char *path, srp_error *error) {
    size_t length = strlen(path);
    char *part = malloc(length + 1);
    if (part == NULL) {
        return srp_fail_at(error, SRP_NO_MEMORY, path, 0, 0, "no memory");
    }
    srp_status status = SRP_OK;
    for (size_t k = 1; k <= length && status == SRP_OK; ++k) {
        if (path[k] != '/' && path[k] != '\0') {
            continue;
        }
        memcpy(part, path, k);
        part[k] = '\0';
        struct stat about;
        if (mkdir(part, 0700) == 0) {
            continue;
        }
        int code = errno;
        bool exists = stat(part, &about) == 0;
        if (!exists || !S_ISDIR(about.st_mode)) {
            errno = exists ? ENOTDIR : code;
            status = fail_write(error, path);
        }
    }
    free(part);
    return status;
}

srp_status srp_platform_lock_file(const char *path, double seconds, int *lock, srp_error *error) {
    const struct timespec pause = {0, 1000000};
    const double end = srp_platform_seconds() + seconds;
    int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0) {
        return fail_write(error, path);
    }
    while (flock(file, LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK && errno != EINTR) {
            srp_status status = srp_platform_fail_errno(error, path, "lock");
            close(file);
            return status;
        }
        if (srp_platform_seconds() >= end) {
            close(file);
            *lock = -1;
            return SRP_OK;
        }
        nanosleep(&pause, NULL);
    }
    *lock = file;
    return SRP_OK;
}

void srp_platform_unlock_file(int lock) {
    close(lock);
}

srp_status srp_platform_list_files(const char *path,
                                   bool (*see)(void *user, const srp_platform_file *file),
                                   void *user, srp_error *error) {
    DIR *directory = opendir(path);
    if (directory == NULL) {
        return srp_platform_fail_errno(error, path, "list");
    }
    for (bool more = true; more;) {
        const struct dirent *entry = readdir(directory);
        struct stat about;
        if (entry == NULL) {
            break;
        }
        if (fstatat(dirfd(directory), entry->d_name, &about, AT_SYMLINK_NOFOLLOW) == 0 &&
            S_ISREG(about.st_mode)) {
            srp_platform_file file = {entry->d_name, (uint64_t)about.st_size,
                                      (int64_t)about.st_mtim.tv_sec * 1000000000 +
                                          about.st_mtim.tv_nsec};
            more = see(user, &file);
        }
    }
    closedir(directory);
    return SRP_OK;
}

void srp_platform_touch_file(const char *path) {
    (void)utimensat(AT_FDCWD, path, NULL, 0);
}

srp_status srp_platform_remove_file(const char *path, srp_error *error) {
    return unlink(path) == 0 ? SRP_OK : srp_platform_fail_errno(error, path, "remove");
}

srp_status srp_platform_rename_file(const char *from, const char *to, srp_error *error) {
    return rename(from, to) == 0 ? SRP_OK : srp_platform_fail_errno(error, from, "rename");
}
