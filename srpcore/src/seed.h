/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers that look random and depend on a seed and a direction alone. Internal. */
#ifndef SRP_SRC_SEED_H
#define SRP_SRC_SEED_H

#include <srp/vec3.h>

#include <stdint.h>
#include <string.h>

/* SplitMix64 (Steele, Lea, Flood 2014): one step of the state by `word`, mixed. */
static inline uint64_t srp_seed_mix(uint64_t state, uint64_t word) {
    uint64_t z = (state ^ word) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static inline uint64_t srp_seed_bits_of(double value) {
    double positive = value + 0.0; /* -0 and 0 are one direction */
    uint64_t bits;
    memcpy(&bits, &positive, sizeof bits);
    return bits;
}

static inline uint64_t srp_seed_of_direction(uint64_t seed, srp_vec3 s) {
    seed = srp_seed_mix(seed, srp_seed_bits_of(s.x));
    seed = srp_seed_mix(seed, srp_seed_bits_of(s.y));
    return srp_seed_mix(seed, srp_seed_bits_of(s.z));
}

/* In [0, 1). */
static inline double srp_seed_unit(uint64_t bits) {
    return (double)(bits >> 11) * 0x1p-53;
}

#endif
