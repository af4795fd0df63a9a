/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Directions of a table's nodes.
 *
 * Sine and cosine are taken of angles reduced to [0, 45] degrees, and the reduction is done in
 * whole numbers (a node's azimuth is a fraction of a turn), so that it costs no rounding: nodes
 * that are mirror images of each other differ in the signs and the order of their components, not
 * in a bit.
 */
#include "error.h"

#include <srp/const.h>
#include <srp/table.h>

#include <math.h>

static const double STEP_MIN_DEG = 0.01;
/* How far `steps * step` may miss the range, in steps: what a step of 10 digits loses. */
static const double STEP_TOLERANCE = 1e-9;

typedef struct sine_cosine {
    double sine, cosine;
} sine_cosine;

/* Of an angle [deg] in [0, 45]. At 45 both are the same bits, which sin() and cos() do not give. */
static sine_cosine of_octant(double angle_deg) {
    sine_cosine r;
    if (angle_deg == 45.0) {
        r.sine = r.cosine = sqrt(0.5);
    } else {
        r.sine = sin(angle_deg * SRP_RAD_PER_DEG);
        r.cosine = cos(angle_deg * SRP_RAD_PER_DEG);
    }
    return r;
}

/* From the octant's values back to the whole turn. `swapped`: the angle was 90 - the reduced one;
 * `obtuse`: 180 - that; `negative`: minus that. Zeros come out positive. */
static sine_cosine unfold(sine_cosine r, bool swapped, bool obtuse, bool negative) {
    if (swapped) {
        double sine = r.sine;
        r.sine = r.cosine;
        r.cosine = sine;
    }
    if (obtuse && r.cosine != 0.0) {
        r.cosine = -r.cosine;
    }
    if (negative && r.sine != 0.0) {
        r.sine = -r.sine;
    }
    return r;
}

/* Of numerator/denominator turns, |numerator| <= denominator / 2. */
static sine_cosine of_turns(int64_t numerator, int64_t denominator) {
    bool negative = numerator < 0;
    /* In eighths of 1/denominator, so that 45, 90 and 180 degrees are whole numbers. */
    int64_t angle = 8 * (negative ? -numerator : numerator);
    int64_t quarter = 2 * denominator;
    bool obtuse = angle > quarter;
    if (obtuse) {
        angle = 2 * quarter - angle;
    }
    bool swapped = 2 * angle > quarter;
    if (swapped) {
        angle = quarter - angle;
    }
    double angle_deg = 45.0 * (double)angle / (double)denominator;
    return unfold(of_octant(angle_deg), swapped, obtuse, negative);
}

/* Of any finite angle; fmod and the differences are exact. */
static sine_cosine of_degrees(double angle_deg) {
    double angle = fabs(fmod(angle_deg, 360.0));
    bool negative = angle_deg < 0.0;
    if (angle > 180.0) {
        angle = 360.0 - angle;
        negative = !negative;
    }
    bool obtuse = angle > 90.0;
    if (obtuse) {
        angle = 180.0 - angle;
    }
    bool swapped = angle > 45.0;
    if (swapped) {
        angle = 90.0 - angle;
    }
    return unfold(of_octant(angle), swapped, obtuse, negative);
}

static srp_vec3 direction(sine_cosine az, sine_cosine el) {
    /* Adding 0 turns a negative zero into a positive one. */
    return srp_vec3_make(el.cosine * az.cosine + 0.0, el.cosine * az.sine + 0.0, el.sine);
}

/* The step nearest to `step_deg` that divides both ranges and is a whole number of thousandths of a
 * degree, so that it can be typed. */
static double nearest_step(double step_deg) {
    const long thousandths = 180000;
    long wanted = lround(180.0 / step_deg);
    for (long away = 0;; ++away) {
        for (int sign = -1; sign <= 1; sign += 2) {
            long count = wanted + sign * away;
            if (count >= 1 && thousandths % count == 0) {
                return 180.0 / (double)count;
            }
        }
    }
}

static srp_status step_count(double step_deg, double range_deg, const char *name, uint32_t *out,
                             srp_error *error) {
    if (!(step_deg >= STEP_MIN_DEG && step_deg <= range_deg)) {
        return srp_fail(error, SRP_BAD_ARGUMENT, "%s step of %g degrees, expected %g to %g", name,
                        step_deg, STEP_MIN_DEG, range_deg);
    }
    double steps = round(range_deg / step_deg);
    if (fabs(steps * step_deg - range_deg) > STEP_TOLERANCE * step_deg) {
        return srp_fail(error, SRP_BAD_ARGUMENT,
                        "%s step of %.10g degrees does not divide %g (%.10g would)", name, step_deg,
                        range_deg, nearest_step(step_deg));
    }
    *out = (uint32_t)steps + 1;
    return SRP_OK;
}

srp_status srp_grid_from_steps(double az_step_deg, double el_step_deg, srp_grid *out,
                               srp_error *error) {
    srp_grid grid;
    srp_status status = step_count(az_step_deg, 360.0, "azimuth", &grid.az_count, error);
    if (status == SRP_OK) {
        status = step_count(el_step_deg, 180.0, "elevation", &grid.el_count, error);
    }
    if (status == SRP_OK) {
        *out = grid;
    }
    return status;
}

size_t srp_grid_node_count(srp_grid grid) {
    return (size_t)grid.az_count * grid.el_count;
}

/* Twice the steps from the middle node to node k of `count`: a whole number whatever the count. */
static int64_t from_middle(uint32_t k, uint32_t count) {
    return 2 * (int64_t)k - ((int64_t)count - 1);
}

double srp_grid_azimuth_deg(srp_grid grid, uint32_t i) {
    return 180.0 * (double)from_middle(i, grid.az_count) / (double)(grid.az_count - 1);
}

double srp_grid_elevation_deg(srp_grid grid, uint32_t j) {
    return 90.0 * (double)from_middle(j, grid.el_count) / (double)(grid.el_count - 1);
}

srp_vec3 srp_grid_direction(srp_grid grid, uint32_t i, uint32_t j) {
    sine_cosine az = of_turns(from_middle(i, grid.az_count), 2 * ((int64_t)grid.az_count - 1));
    sine_cosine el = of_turns(from_middle(j, grid.el_count), 4 * ((int64_t)grid.el_count - 1));
    return direction(az, el);
}

double srp_grid_solid_angle(srp_grid grid, uint32_t i, uint32_t j) {
    double half = 90.0 / (double)(grid.el_count - 1);
    double el = srp_grid_elevation_deg(grid, j);
    double high = fmin(el + half, 90.0), low = fmax(el - half, -90.0);
    double band = sin(high * SRP_RAD_PER_DEG) - sin(low * SRP_RAD_PER_DEG);
    bool seam = i == 0 || i == grid.az_count - 1;
    return 2.0 * SRP_PI / (double)(grid.az_count - 1) * (seam ? 0.5 * band : band);
}

srp_vec3 srp_direction_from_deg(double az_deg, double el_deg) {
    return direction(of_degrees(az_deg), of_degrees(el_deg));
}
