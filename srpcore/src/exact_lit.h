/* SPDX-License-Identifier: Apache-2.0 */
/* From sunlit parts of facets to sums per material. Internal. */
#ifndef SRP_SRC_EXACT_LIT_H
#define SRP_SRC_EXACT_LIT_H

#include "exact_visible.h"
#include "method_internal.h"
#include "scene_internal.h"

/* Adds sunlit parts to the (material count + 1) sums. */
static inline void srp_exact_add_lit(const srp_scene *scene, srp_vec3 reference, const srp_lit *lit,
                                     srp_basis *basis) {
    uint32_t material = scene->facets[lit->facet].material;
    bool absorbs = lit->back && scene->optics[material].one_sided;
    srp_basis_add(&basis[absorbs ? scene->material_count : material], lit->area, lit->cosine,
                  lit->normal, srp_vec3_sub(lit->centroid, reference));
}

#endif
