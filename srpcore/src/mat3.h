/* SPDX-License-Identifier: Apache-2.0 */
/* Matrices of 3 x 3, row by row. Internal. */
#ifndef SRP_SRC_MAT3_H
#define SRP_SRC_MAT3_H

#include <srp/vec3.h>

static inline srp_vec3 srp_mat3_apply(const double m[3][3], srp_vec3 v) {
    return srp_vec3_make(m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
                         m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                         m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z);
}

/* By the transpose: the inverse of a rotation. */
static inline srp_vec3 srp_mat3_apply_transposed(const double m[3][3], srp_vec3 v) {
    return srp_vec3_make(m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z,
                         m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
                         m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z);
}

static inline void srp_mat3_multiply(const double a[3][3], const double b[3][3], double out[3][3]) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
        }
    }
}

/* Adds a vector to a column. */
static inline void srp_mat3_add_column(double m[3][3], int column, srp_vec3 v) {
    m[0][column] += v.x;
    m[1][column] += v.y;
    m[2][column] += v.z;
}

static inline srp_vec3 srp_mat3_column(const double m[3][3], int column) {
    return srp_vec3_make(m[0][column], m[1][column], m[2][column]);
}

/* The unit vector of an axis: 0, 1, 2. */
static inline srp_vec3 srp_axis(int index) {
    return srp_vec3_make(index == 0, index == 1, index == 2);
}

static inline srp_vec3 srp_unit(srp_vec3 v) {
    return srp_vec3_scale(1.0 / srp_vec3_norm(v), v);
}

#endif
