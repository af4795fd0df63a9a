/* SPDX-License-Identifier: Apache-2.0 */
/* Everything that only POSIX or glibc offers, in one place: nothing else assumes it. Internal. */
#ifndef SRP_SRC_PLATFORM_H
#define SRP_SRC_PLATFORM_H

#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Processors that this process may use, at least 1. */
int srp_platform_processor_count(void);

/* Memory from the heap for a table that is read all over, aligned to 64 bytes. A large one is put
 * on large pages where the system has them, which spares the processor most of its address
 * look-ups. NULL: no memory. */
void *srp_platform_allocate_table(size_t size);

/* Number formats of the C locale ('.' as decimal point) for the calling thread, whatever the
 * program has set. Nestable pairs around every reader and writer of text. */
typedef struct srp_c_locale {
    void *previous;
    void *ours;
} srp_c_locale;
srp_c_locale srp_platform_c_locale_enter(void);
void srp_platform_c_locale_leave(srp_c_locale state);

/* Looks at each piece of a file as it comes in, in order; anything but SRP_OK ends the reading. */
typedef srp_status (*srp_platform_inspect)(void *user, const char *bytes, size_t size,
                                           srp_error *error);

/* Reads a whole file, with a 0 byte behind it; *text is freed by free(). SRP_NOT_FOUND, SRP_IO (a
 * directory, no permission, a read error), SRP_NO_MEMORY; the message says which; or what `inspect`
 * says. Readers of text call srp_text_read_file(), which refuses what is no text. */
srp_status srp_platform_read_file(const char *path, srp_platform_inspect inspect, void *user,
                                  char **text, size_t *size, srp_error *error);

/*
 * A file that appears whole or not at all: written under a temporary name in the target's directory
 * (srp_platform_draft.path, opened or not), then renamed over the target by _commit(), which also
 * flushes it to the disk; _abandon() removes it. Both end the draft.
 */
typedef struct srp_platform_draft {
    char *path; /* of the temporary file */
    char *target;
} srp_platform_draft;
srp_status srp_platform_draft_begin(const char *target, srp_platform_draft *out, srp_error *error);
srp_status srp_platform_draft_commit(srp_platform_draft *draft, srp_error *error);
void srp_platform_draft_abandon(srp_platform_draft *draft);

/* Writes a whole file by such a draft. SRP_IO, SRP_NO_MEMORY; the message says why. */
srp_status srp_platform_write_file(const char *path, const char *bytes, size_t size,
                                   srp_error *error);

/*
 * A shared library of the system, looked for at run time: the first of `names` (ends with NULL)
 * that is there. It stays mapped when it is closed: libraries that start threads of their own do
 * not bear to be taken away. NULL: none is there; *reason (size bytes) says what the loader said of
 * the last.
 */
typedef struct srp_platform_library srp_platform_library;
srp_platform_library *srp_platform_library_open(const char *const *names, char *reason,
                                                size_t size);
/* May be NULL. */
void srp_platform_library_close(srp_platform_library *library);
/* A function of it, for a cast to its type; NULL: it has none of this name. */
typedef void (*srp_platform_function)(void);
srp_platform_function srp_platform_library_function(srp_platform_library *library,
                                                    const char *name);

/* ---- The cache: directories, locks of files ---- */

/* Where programs keep what they can make again: $XDG_CACHE_HOME, else ~/.cache, and in it `name`;
 * freed by free(). SRP_NOT_FOUND (neither is set), SRP_NO_MEMORY. */
srp_status srp_platform_cache_directory(const char *name, char **out, srp_error *error);
/* Makes a directory and those above it, for the user alone, where they do not exist. SRP_IO,
 * SRP_NO_MEMORY. */
srp_status srp_platform_make_directory(const char *path, srp_error *error);
/* Locks a file, which is made for that, against all who do the same, threads of this process
 * included; the lock ends with _unlock() or with the process. *lock is -1 if others have held it
 * for `seconds`. SRP_IO. */
srp_status srp_platform_lock_file(const char *path, double seconds, int *lock, srp_error *error);
void srp_platform_unlock_file(int lock);
/* Shows all plain files of a directory that exists; `see` returns false to stop. SRP_NOT_FOUND,
 * SRP_IO. */
typedef struct srp_platform_file {
    const char *name; /* in the directory */
    uint64_t size;    /* [byte] */
    int64_t changed;  /* [ns since 1970] */
} srp_platform_file;
srp_status srp_platform_list_files(const char *path,
                                   bool (*see)(void *user, const srp_platform_file *file),
                                   void *user, srp_error *error);
/* Sets the time of last change to now, if it can be. */
void srp_platform_touch_file(const char *path);
/* SRP_NOT_FOUND, SRP_IO. */
srp_status srp_platform_remove_file(const char *path, srp_error *error);
srp_status srp_platform_rename_file(const char *from, const char *to, srp_error *error);

/* ---- Threads ---- */

/* A lock with a bell, for few and short waits: what <threads.h> offers, by the calls that
 * ThreadSanitizer knows. wait() gives the lock up until the bell rings, and may come back without.
 */
typedef struct srp_platform_monitor srp_platform_monitor;
srp_platform_monitor *srp_platform_monitor_create(void); /* NULL: no memory */
void srp_platform_monitor_destroy(srp_platform_monitor *monitor);
void srp_platform_monitor_enter(srp_platform_monitor *monitor);
void srp_platform_monitor_leave(srp_platform_monitor *monitor);
void srp_platform_monitor_wait(srp_platform_monitor *monitor);
void srp_platform_monitor_ring(srp_platform_monitor *monitor); /* wakes all that wait */

/* One lock of the whole process around NetCDF, which is not made for threads. */
void srp_platform_netcdf_enter(void);
void srp_platform_netcdf_leave(void);

/* Seconds of a clock that only goes forward. */
double srp_platform_seconds(void);

/* Sets an SRP_IO (or SRP_NOT_FOUND, for ENOENT) error on `path` in the words of errno: "cannot
 * WHAT: No space left on device". */
srp_status srp_platform_fail_errno(srp_error *error, const char *path, const char *what);

#endif
