/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions compiled several times for wider vector units, the best chosen when the program is
 * loaded. With -ffp-contract=off and no reordering of sums every clone gives the same bits.
 * The wider ones are those for AVX2 and AVX-512. SRP_NO_TARGET_CLONES turns it off (sanitizers need
 * that). Internal.
 */
#ifndef SRP_SRC_CLONES_H
#define SRP_SRC_CLONES_H

#if !defined(SRP_NO_TARGET_CLONES) && defined(__x86_64__) && defined(__gnu_linux__) &&             \
    defined(__GNUC__) && !defined(__clang__)
/* Levels rather than single features: what counts bits comes with them. */
#if __GNUC__ >= 12
#define SRP_TARGET_CLONES                                                                          \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define SRP_TARGET_CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#endif
#else
#define SRP_TARGET_CLONES
#endif

/* A part of such functions: inlined, or else it would be compiled for the plainest processor. */
#if defined(__GNUC__)
#define SRP_CLONE_PART static inline __attribute__((always_inline))
#else
#define SRP_CLONE_PART static inline
#endif

#endif
