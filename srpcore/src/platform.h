/* SPDX-License-Identifier: Apache-2.0 */
/* Everything that only POSIX or glibc offers, in one place: nothing else assumes it. Internal. */
#ifndef SRP_SRC_PLATFORM_H
#define SRP_SRC_PLATFORM_H

#include <srp/status.h>

#include <stdbool.h>
#include <stddef.h>
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

/* Sets an SRP_IO (or SRP_NOT_FOUND, for ENOENT) error on `path` in the words of errno: "cannot
 * WHAT: No space left on device". */
srp_status srp_platform_fail_errno(srp_error *error, const char *path, const char *what);

#endif
