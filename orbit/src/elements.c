/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"

#include <srp/const.h>
#include <srp/orbit/elements.h>

#include <math.h>

static double turn(double angle) {
    const double wrapped = fmod(angle, 2.0 * SRP_PI);
    return wrapped < 0.0 ? wrapped + 2.0 * SRP_PI : wrapped;
}

/* Angle from a to b about the axis n, all but n of any length. */
static double angle_about(srp_vec3 n, srp_vec3 a, srp_vec3 b) {
    return turn(atan2(srp_vec3_dot(n, srp_vec3_cross(a, b)), srp_vec3_dot(a, b)));
}

/* Below these an orbit has no node or no periapsis that means anything in double precision. */
static const double FLAT = 1e-11, CIRCULAR = 1e-11;

srp_elements srp_elements_from_state(double mu, srp_vec3 r, srp_vec3 v) {
    srp_elements out;
    const double rn = srp_vec3_norm(r), v2 = srp_vec3_dot(v, v);
    const srp_vec3 h = srp_vec3_cross(r, v);
    const srp_vec3 n = srp_vec3_scale(1.0 / srp_vec3_norm(h), h);
    const srp_vec3 e =
        srp_vec3_scale(1.0 / mu, srp_vec3_sub(srp_vec3_scale(v2 - mu / rn, r),
                                              srp_vec3_scale(srp_vec3_dot(r, v), v)));
    out.a = 1.0 / (2.0 / rn - v2 / mu);
    out.e = srp_vec3_norm(e);
    out.i = atan2(hypot(n.x, n.y), n.z);
    const double sine = hypot(n.x, n.y);
    const srp_vec3 node =
        sine > FLAT ? srp_vec3_make(-n.y, n.x, 0.0) : srp_vec3_make(1.0, 0.0, 0.0);
    out.raan = sine > FLAT ? turn(atan2(n.x, -n.y)) : 0.0;
    out.argp = out.e > CIRCULAR ? angle_about(n, node, e) : 0.0;
    out.nu = angle_about(n, out.e > CIRCULAR ? e : node, r);
    return out;
}

srp_status srp_elements_to_state(double mu, const srp_elements *el, srp_vec3 *r, srp_vec3 *v,
                                 srp_error *error) {
    const double p = el->a * (1.0 - el->e * el->e);
    const double q = 1.0 + el->e * cos(el->nu);
    if (!(p > 0.0 && el->e >= 0.0 && q > 0.0 && mu > 0.0 &&
          isfinite(p + el->i + el->raan + el->argp + el->nu))) {
        return srp_fail(
            error, SRP_BAD_ARGUMENT,
            "elements a = %g m, e = %g, true anomaly %g rad: there is no such orbit; expected "
            "a > 0 with 0 <= e < 1, or a < 0 with e > 1 and an anomaly between the "
            "asymptotes",
            el->a, el->e, el->nu);
    }
    const double u = el->argp + el->nu, ci = cos(el->i), si = sin(el->i);
    const double co = cos(el->raan), so = sin(el->raan), rn = p / q, k = sqrt(mu / p);
    const srp_vec3 node = srp_vec3_make(co, so, 0.0), up = srp_vec3_make(-so * ci, co * ci, si);
    const double vn = -k * (sin(u) + el->e * sin(el->argp));
    const double vu = k * (cos(u) + el->e * cos(el->argp));
    *r = srp_vec3_add(srp_vec3_scale(rn * cos(u), node), srp_vec3_scale(rn * sin(u), up));
    *v = srp_vec3_add(srp_vec3_scale(vn, node), srp_vec3_scale(vu, up));
    return SRP_OK;
}

/* Stumpff's c2 and c3. */
static void stumpff(double z, double *c2, double *c3) {
    if (fabs(z) < 0.1) {
        *c2 = *c3 = 0.0;
        double term2 = 0.5, term3 = 1.0 / 6.0;
        for (int k = 1; k < 12; ++k) {
            *c2 += term2;
            *c3 += term3;
            term2 *= -z / ((2.0 * k + 1.0) * (2.0 * k + 2.0));
            term3 *= -z / ((2.0 * k + 2.0) * (2.0 * k + 3.0));
        }
    } else if (z > 0.0) {
        const double s = sqrt(z);
        *c2 = (1.0 - cos(s)) / z;
        *c3 = (s - sin(s)) / (s * z);
    } else {
        const double s = sqrt(-z);
        *c2 = (1.0 - cosh(s)) / z;
        *c3 = (sinh(s) - s) / (-z * s);
    }
}

/* H. D. Curtis, "Orbital Mechanics for Engineering Students", 3.7, by Newton with Laguerre's guard.
 */
srp_status srp_elements_kepler(double mu, double dt, srp_vec3 *r, srp_vec3 *v, srp_error *error) {
    const double rn = srp_vec3_norm(*r), root = sqrt(mu);
    const double alpha = 2.0 / rn - srp_vec3_dot(*v, *v) / mu;
    const double sigma = srp_vec3_dot(*r, *v) / root;
    double chi = alpha > 0.0 ? root * alpha * dt : root * dt / (10.0 * rn), c2 = 0.0, c3 = 0.0;
    if (alpha > 0.0) { /* whole turns change nothing */
        const double period = 2.0 * SRP_PI / (root * alpha * sqrt(alpha));
        dt = remainder(dt, period);
        chi = root * alpha * dt;
    }
    for (int k = 0; k < 100; ++k) {
        const double x2 = chi * chi, z = alpha * x2;
        stumpff(z, &c2, &c3);
        const double f =
            sigma * x2 * c2 + (1.0 - alpha * rn) * x2 * chi * c3 + rn * chi - root * dt;
        const double d = sigma * chi * (1.0 - z * c3) + (1.0 - alpha * rn) * x2 * c2 + rn;
        const double dd = sigma * (1.0 - z * c2) + (1.0 - alpha * rn) * chi * (1.0 - z * c3);
        const double under = sqrt(fabs(16.0 * d * d - 20.0 * f * dd));
        const double change = 5.0 * f / (d + copysign(under, d));
        chi -= change;
        if (fabs(change) <= 1e-14 * fabs(chi) || fabs(f) <= 1e-15 * fabs(root * dt)) {
            stumpff(alpha * chi * chi, &c2, &c3);
            const double f1 = 1.0 - chi * chi / rn * c2, g1 = dt - chi * chi * chi / root * c3;
            const srp_vec3 r0 = *r, v0 = *v;
            const srp_vec3 r1 = srp_vec3_add(srp_vec3_scale(f1, r0), srp_vec3_scale(g1, v0));
            const double n1 = srp_vec3_norm(r1);
            const double fd = root / (n1 * rn) * (alpha * chi * chi * chi * c3 - chi);
            const double gd = 1.0 - chi * chi / n1 * c2;
            *r = r1;
            *v = srp_vec3_add(srp_vec3_scale(fd, r0), srp_vec3_scale(gd, v0));
            return SRP_OK;
        }
    }
    return srp_fail(error, SRP_BAD_ARGUMENT, "Kepler's equation has not converged");
}
