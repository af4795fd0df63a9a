/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Methods: how a scene answers sunlight. Each is a constant table of functions; callers prepare one
 * on a scene, ask it for batches of directions, and release it.
 *
 *     srp_prepared *prepared;
 *     srp_method_params params = srp_method_params_default();
 *     status = srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error);
 *     status = srp_prepared_respond(prepared, count, s_body, responses, NULL, &error);
 *     srp_prepared_release(prepared);
 */
#ifndef SRP_METHOD_H
#define SRP_METHOD_H

#include <srp/response.h>
#include <srp/scene.h>
#include <srp/status.h>
#include <srp/vec3.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

SRP_BEGIN_DECLS

/* How the samples of a sampling method lie in the plane that faces the Sun. */
typedef enum srp_lattice_kind {
    /* Square cells, turned by 31.7 degrees against the body axes and fitted to the silhouette's own
     * box, one shift per direction. The default: no edge of a spacecraft lies along it. */
    SRP_LATTICE_TURNED = 0,
    /* The user's pixel array: columns along the direction of growing azimuth, rows along that of
     * growing elevation, cell centres sampled, fixed window. What AAS 20-481 uses. */
    SRP_LATTICE_WINDOW = 1
} srp_lattice_kind;

/* One size of the turned lattice is in force: `pixel` when it is > 0, else `samples`. */
typedef struct srp_lattice_params {
    srp_lattice_kind kind;
    uint32_t samples;       /* turned: cells along the longer side of the box, 1 to 32768 */
    double pixel;           /* turned: side of a cell [m]; NAN = by `samples` */
    double window[4];       /* window: u_min, u_max, v_min, v_max [m], about the body origin */
    uint32_t columns, rows; /* window: cells, 1 to 32768 each */
} srp_lattice_params;

typedef struct srp_method_params {
    srp_vec3 reference; /* point that moments are taken about [m], body frame, each up to 1e30 */
    int threads;        /* > 0; results do not depend on it */
    uint64_t seed;      /* of everything drawn at random; part of the result */
    srp_lattice_params lattice;
    double tolerance;     /* asked standard error of f over |f|; INFINITY = as it comes */
    uint32_t max_samples; /* cells along a side beyond which `tolerance` gives up */
    uint32_t reflections; /* bounces that light is followed for after its first hit, 0 to 100 */
    uint32_t diffuse;     /* rays that carry the diffuse light of a first hit, 0 to 1024; 0 = single
                             scattering: diffuse light is not followed */
    /* Mirrored beams that are followed exactly for one direction, at most: where it would take
     * more, mirrored light is sampled (SRP_RESPONSE_MIRRORS_SAMPLED). 0 = always sampled. */
    uint32_t mirrored_beams;
} srp_method_params;

/* reference 0, one thread per processor, seed 0, turned lattice of 512, no tolerance, 8192, 2
 * reflections, single scattering, 8192 beams. */
SRP_API srp_method_params srp_method_params_default(void);

/* What a method can do; bits. */
enum {
    SRP_METHOD_EXACT = 1,   /* no sampling error: f_error is 0 */
    SRP_METHOD_BASIS = 2,   /* can give per-material sums */
    SRP_METHOD_LATTICE = 4, /* uses params.lattice, tolerance, max_samples */
    SRP_METHOD_MOMENT = 8,  /* gives t; without it t is 0 */
    SRP_METHOD_BOUNCE = 16  /* follows reflected light: uses params.reflections, diffuse,
                               mirrored_beams */
};

typedef struct srp_method srp_method;
typedef struct srp_prepared srp_prepared;

struct srp_method {
    const char *name;      /* as users write it */
    const char *device;    /* "cpu" */
    const char *summary;   /* one line for help texts */
    unsigned shapes;       /* SRP_SHAPE_... it takes, joined */
    unsigned capabilities; /* SRP_METHOD_... */
    /* The implementation; call it through the functions below. */
    srp_status (*prepare)(const srp_scene *scene, const srp_method_params *params,
                          srp_prepared **out, srp_error *error);
    srp_status (*respond)(const srp_prepared *prepared, size_t count, const srp_vec3 *s_body,
                          srp_response *responses, srp_basis *basis, srp_error *error);
    void (*release)(srp_prepared *prepared);
};

SRP_API extern const srp_method srp_method_cannonball; /* AAS 20-481, Eq. 4 */
SRP_API extern const srp_method srp_method_nplate;     /* AAS 20-481, Eq. 5 */
SRP_API extern const srp_method srp_method_exact;      /* first hit, by polygon clipping */
SRP_API extern const srp_method srp_method_raycast;    /* first hit, sampled */
SRP_API extern const srp_method
    srp_method_raytrace; /* first hit and mirrored light exact, diffuse light sampled */

/* All methods of this library, in the order above; *count of them. Constant. */
SRP_API const srp_method *const *srp_method_list(size_t *count);

/*
 * Builds what `method` needs to answer for `scene`, which must outlive the result.
 * SRP_BAD_ARGUMENT (a parameter out of range; the message names it), SRP_UNSUPPORTED (the method
 * does not take a scene of this shape), SRP_NO_MEMORY.
 */
SRP_API SRP_CHECK srp_status srp_method_prepare(const srp_method *method, const srp_scene *scene,
                                                const srp_method_params *params, srp_prepared **out,
                                                srp_error *error);

/*
 * Answers `count` directions.
 *   s_body     unit vectors spacecraft -> Sun, body frame; unit to 1e-9 (used as given), else
 *              SRP_BAD_ARGUMENT, as for NaN
 *   responses  (count)
 *   basis      NULL, or (count, material count + 1) per-material sums, direction by direction; the
 *              last of each row is the absorbing backs of one-sided materials, whose optics are
 *              0, 0. SRP_UNSUPPORTED when the method lacks SRP_METHOD_BASIS
 * Runs on up to params.threads threads; a response depends on its direction alone, to the bit.
 * Several threads may call it on one `prepared` at once. SRP_NO_MEMORY.
 */
SRP_API SRP_CHECK srp_status srp_prepared_respond(const srp_prepared *prepared, size_t count,
                                                  const srp_vec3 *s_body, srp_response *responses,
                                                  srp_basis *basis, srp_error *error);
SRP_API void srp_prepared_release(srp_prepared *prepared);

SRP_API const srp_method *srp_prepared_method(const srp_prepared *prepared);
SRP_API const srp_scene *srp_prepared_scene(const srp_prepared *prepared);
SRP_API const srp_method_params *srp_prepared_params(const srp_prepared *prepared);

SRP_END_DECLS

#endif
