/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Statuses and error detail.
 *
 * Every function that can fail returns an srp_status (0 = done) and leaves its out parameters
 * unchanged unless it is SRP_OK. What went wrong, in words and with its place in a file, goes to
 * the caller's srp_error, which may be NULL. The library itself never prints, exits or aborts.
 */
#ifndef SRP_STATUS_H
#define SRP_STATUS_H

#include <srp/export.h>

#include <stddef.h>

SRP_BEGIN_DECLS

/* X(name, value, what it means) */
#define SRP_STATUS_LIST(X)                                                                         \
    X(SRP_OK, 0, "done")                                                                           \
    X(SRP_BAD_ARGUMENT, 1, "an argument is outside its range")                                     \
    X(SRP_NOT_FOUND, 2, "a file or a name does not exist")                                         \
    X(SRP_BAD_FORMAT, 3, "a file is not what its format asks for")                                 \
    X(SRP_BAD_DATA, 4, "a file is well formed, but its content is physically impossible")          \
    X(SRP_MISMATCH, 5, "two things that must belong together do not")                              \
    X(SRP_UNSUPPORTED, 6, "the method or format does not offer what was asked for")                \
    X(SRP_CANCELLED, 7, "cancelled by the caller")                                                 \
    X(SRP_NO_MEMORY, 8, "out of memory")                                                           \
    X(SRP_IO, 9, "the system could not read or write a file")                                      \
    X(SRP_NO_DEVICE, 10, "the machine lacks the device that was asked for, or it does not work")

#define SRP_STATUS_ENUM(name, value, text) name = value,
typedef enum srp_status { SRP_STATUS_LIST(SRP_STATUS_ENUM) } srp_status;
#undef SRP_STATUS_ENUM

/* What a caller can state to get past a failure. The library does not know how: a program adds
 * where that goes, an option, an entry of a file, a field. */
typedef enum srp_remedy {
    SRP_REMEDY_NONE,
    SRP_REMEDY_OPTICS,     /* optics of the material: the message ends `give ... in the MTL file` */
    SRP_REMEDY_MASS,       /* the mass of the spacecraft */
    SRP_REMEDY_BASIS,      /* that a table keeps sums per material */
    SRP_REMEDY_KEEP_BOUNCE /* that reflected light stays as it was traced */
} srp_remedy;

/* Detail of a failure. Plain data, no ownership: put one on the stack. */
typedef struct srp_error {
    srp_status status;
    char file[512];    /* name of the file at fault, "" if none (long names keep their end) */
    size_t line;       /* 1-based, 0 = does not apply */
    size_t column;     /* 1-based byte in the line, 0 = does not apply */
    char message[768]; /* one sentence: what was found and what was expected */
    srp_remedy remedy;
} srp_error;

/* Warnings on the way in: called once per message, from the calling thread. A NULL srp_log, or one
 * whose warn is NULL, drops them. */
typedef struct srp_log {
    void (*warn)(void *user, const srp_error *what);
    void *user;
} srp_log;

/* Meaning of a status as a constant string; never NULL. Any thread. */
SRP_API const char *srp_status_string(srp_status status);

/* Writes "file:line:column: message" (parts that do not apply left out) to `buffer`, always
 * terminated; returns the length of the full text as snprintf does. Any thread. */
SRP_API size_t srp_error_format(const srp_error *error, char *buffer, size_t size);

SRP_END_DECLS

#endif
