/* SPDX-License-Identifier: Apache-2.0 */
#include "raster_frame.h"

#include "clones.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LANES = 8 }; /* numbers at a time */

/* ---- mesh ---- */

static srp_raster_surface surface_of(srp_optics optics, size_t row) {
    srp_raster_surface surface;
    surface.along = 1.0 - optics.rho_s;
    surface.specular = 2.0 * optics.rho_s;
    surface.diffuse = 2.0 / 3.0 * optics.rho_d;
    surface.row = row;
    return surface;
}

static void lay_out(srp_raster_mesh *mesh, const srp_scene *scene) {
    const srp_optics black = {0.0, 0.0, false};
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        mesh->x[i] = scene->vertices[i].x;
        mesh->y[i] = scene->vertices[i].y;
        mesh->z[i] = scene->vertices[i].z;
    }
    for (size_t k = 0; k < scene->facet_count; ++k) {
        const srp_facet *facet = &scene->facets[k];
        mesh->nx[k] = facet->normal.x;
        mesh->ny[k] = facet->normal.y;
        mesh->nz[k] = facet->normal.z;
        memcpy(mesh->v[k], facet->v, sizeof mesh->v[k]);
        mesh->material[k] = facet->material;
        mesh->open[k] = !facet->closed;
    }
    for (size_t m = 0; m < scene->material_count; ++m) {
        srp_optics optics = scene->optics[m];
        mesh->surface[m][0] = surface_of(optics, m);
        mesh->surface[m][1] =
            optics.one_sided ? surface_of(black, scene->material_count) : surface_of(optics, m);
    }
}

bool srp_raster_mesh_create(srp_raster_mesh *mesh, const srp_scene *scene) {
    size_t vertices = scene->vertex_count, facets = scene->facet_count;
    memset(mesh, 0, sizeof *mesh);
    mesh->vertex_count = vertices;
    mesh->facet_count = facets;
    mesh->all_closed = scene->all_closed;
    mesh->x = malloc(3 * vertices * sizeof *mesh->x);
    mesh->nx = malloc(3 * facets * sizeof *mesh->nx);
    mesh->v = malloc(facets * sizeof *mesh->v);
    mesh->material = malloc(facets * sizeof *mesh->material);
    mesh->open = malloc(facets * sizeof *mesh->open);
    mesh->surface = malloc(scene->material_count * sizeof *mesh->surface);
    if (mesh->x == NULL || mesh->nx == NULL || mesh->v == NULL || mesh->material == NULL ||
        mesh->open == NULL || mesh->surface == NULL) {
        srp_raster_mesh_clear(mesh);
        return false;
    }
    mesh->y = mesh->x + vertices;
    mesh->z = mesh->y + vertices;
    mesh->ny = mesh->nx + facets;
    mesh->nz = mesh->ny + facets;
    lay_out(mesh, scene);
    return true;
}

void srp_raster_mesh_clear(srp_raster_mesh *mesh) {
    free(mesh->x);
    free(mesh->nx);
    free(mesh->v);
    free(mesh->material);
    free(mesh->open);
    free(mesh->surface);
    memset(mesh, 0, sizeof *mesh);
}

/* ---- frame ---- */

bool srp_raster_frame_create(srp_raster_frame *frame, const srp_raster_mesh *mesh) {
    memset(frame, 0, sizeof *frame);
    frame->mesh = mesh;
    frame->x = malloc(3 * mesh->vertex_count * sizeof *frame->x);
    frame->ceiling = malloc(mesh->vertex_count * sizeof *frame->ceiling);
    frame->cosine = malloc(mesh->facet_count * sizeof *frame->cosine);
    /* One to spare: what is listed is written before it is known to count. */
    frame->facet = malloc((mesh->facet_count + 1) * sizeof *frame->facet);
    frame->rows = malloc((mesh->facet_count + 1) * sizeof *frame->rows);
    if (frame->x == NULL || frame->ceiling == NULL || frame->cosine == NULL ||
        frame->facet == NULL || frame->rows == NULL) {
        srp_raster_frame_clear(frame);
        return false;
    }
    frame->y = frame->x + mesh->vertex_count;
    frame->depth = frame->y + mesh->vertex_count;
    return true;
}

void srp_raster_frame_clear(srp_raster_frame *frame) {
    free(frame->x);
    free(frame->ceiling);
    free(frame->cosine);
    free(frame->facet);
    free(frame->rows);
    memset(frame, 0, sizeof *frame);
}

/* Least and greatest of several numbers at a time, folded at the end. */
typedef struct ranges {
    double low[LANES], high[LANES];
} ranges;

static ranges ranges_empty(void) {
    ranges out;
    for (int k = 0; k < LANES; ++k) {
        out.low[k] = INFINITY;
        out.high[k] = -INFINITY;
    }
    return out;
}

static void ranges_fold(const ranges *range, double *low, double *high) {
    *low = range->low[0];
    *high = range->high[0];
    for (int k = 1; k < LANES; ++k) {
        *low = fmin(*low, range->low[k]);
        *high = fmax(*high, range->high[k]);
    }
}

/* Projects vertices [begin, end), at most LANES of them, onto three axes. */
static inline void project_some(const srp_raster_mesh *mesh, const srp_view *axes,
                                const srp_raster_frame *frame, size_t begin, size_t end,
                                ranges along[3]) {
    const double *restrict px = mesh->x, *restrict py = mesh->y, *restrict pz = mesh->z;
    double *restrict out[3] = {frame->x, frame->y, frame->depth};
    const srp_vec3 axis[3] = {axes->u, axes->v, axes->s};
    for (int a = 0; a < 3; ++a) {
        double *restrict low = along[a].low, *restrict high = along[a].high;
        for (size_t i = begin; i < end; ++i) {
            double p = px[i] * axis[a].x + py[i] * axis[a].y + pz[i] * axis[a].z;
            out[a][i] = p;
            low[i - begin] = p < low[i - begin] ? p : low[i - begin];
            high[i - begin] = p > high[i - begin] ? p : high[i - begin];
        }
    }
}

SRP_TARGET_CLONES
static void project(const srp_raster_mesh *mesh, const srp_view *axes,
                    const srp_raster_frame *frame, ranges along[3]) {
    size_t whole = mesh->vertex_count - mesh->vertex_count % LANES;
    for (size_t i = 0; i < whole; i += LANES) {
        project_some(mesh, axes, frame, i, i + LANES, along);
    }
    project_some(mesh, axes, frame, whole, mesh->vertex_count, along);
}

srp_extent srp_raster_frame_project(srp_raster_frame *frame, const srp_view *axes) {
    srp_extent extent;
    double near, far;
    ranges along[3] = {ranges_empty(), ranges_empty(), ranges_empty()};
    project(frame->mesh, axes, frame, along);
    ranges_fold(&along[0], &extent.u_min, &extent.u_max);
    ranges_fold(&along[1], &extent.v_min, &extent.v_max);
    ranges_fold(&along[2], &far, &near);
    /* Some thousand units of the last place of what heights are made from. */
    double size = fmax(fmax(fabs(near), fabs(far)), near - far);
    frame->tie =
        ldexp(fmax(size, fmax(extent.u_max - extent.u_min, extent.v_max - extent.v_min)), -40);
    frame->extent = extent;
    return extent;
}

/* Metres to lattice coordinates, in place. */
SRP_TARGET_CLONES
static void to_lattice(size_t count, const srp_lattice *lattice, double *restrict x,
                       double *restrict y, int32_t (*restrict ceiling)[2]) {
    const double u0 = lattice->u0, v0 = lattice->v0;
    const double per_u = 1.0 / lattice->du, per_v = 1.0 / lattice->dv;
    const double columns = lattice->columns, rows = lattice->rows;
    for (size_t i = 0; i < count; ++i) {
        x[i] = (x[i] - u0) * per_u;
        y[i] = (y[i] - v0) * per_v;
        ceiling[i][0] = srp_ceil_within(x[i], columns);
        ceiling[i][1] = srp_ceil_within(y[i], rows);
    }
}

SRP_TARGET_CLONES
static void find_cosines(const srp_raster_mesh *mesh, srp_vec3 s, double *restrict cosine) {
    const double *restrict nx = mesh->nx, *restrict ny = mesh->ny, *restrict nz = mesh->nz;
    size_t count = mesh->facet_count;
    for (size_t k = 0; k < count; ++k) {
        cosine[k] = nx[k] * s.x + ny[k] * s.y + nz[k] * s.z;
    }
}

/* False when all samples lie to one side of the facet; its rows. */
static inline bool may_be_hit(const uint32_t v[3], const int32_t (*ceiling)[2], int32_t rows[2]) {
    const int32_t *a = ceiling[v[0]], *b = ceiling[v[1]], *c = ceiling[v[2]];
    int32_t low = a[1] < b[1] ? a[1] : b[1], high = a[1] < b[1] ? b[1] : a[1];
    rows[0] = low < c[1] ? low : c[1];
    rows[1] = high > c[1] ? high : c[1];
    bool columns = (a[0] != b[0]) | (a[0] != c[0]);
    return columns & (rows[0] != rows[1]);
}

/* Lists facets that samples may hit; returns how many. Those turned to the Sun come first: the
 * order of drawing breaks ties of depth. */
SRP_TARGET_CLONES
static size_t list_facets(srp_raster_frame *frame) {
    const srp_raster_mesh *mesh = frame->mesh;
    const int32_t(*ceiling)[2] = (const int32_t(*)[2])frame->ceiling;
    const double *restrict cosine = frame->cosine;
    uint32_t *restrict facet = frame->facet;
    int32_t(*restrict rows)[2] = frame->rows;
    size_t turned = 0, count = 0;
    for (size_t k = 0; k < mesh->facet_count; ++k) {
        facet[turned] = (uint32_t)k;
        turned += cosine[k] > 0.0;
    }
    for (size_t n = 0; n < turned; ++n) {
        uint32_t k = facet[n];
        facet[count] = k;
        count += may_be_hit(mesh->v[k], ceiling, rows[count]);
    }
    if (!mesh->all_closed) {
        for (size_t k = 0; k < mesh->facet_count; ++k) {
            if (cosine[k] < 0.0 && mesh->open[k] && may_be_hit(mesh->v[k], ceiling, rows[count])) {
                facet[count++] = (uint32_t)k;
            }
        }
    }
    return count;
}

void srp_raster_frame_bind(srp_raster_frame *frame, srp_lattice_kind kind,
                           const srp_lattice *lattice) {
    const srp_raster_mesh *mesh = frame->mesh;
    frame->kind = kind;
    frame->lattice = *lattice;
    to_lattice(mesh->vertex_count, lattice, frame->x, frame->y, frame->ceiling);
    find_cosines(mesh, lattice->view.s, frame->cosine);
    frame->facet_count = list_facets(frame);
}

bool srp_raster_frame_is_cut(const srp_raster_frame *frame) {
    const srp_lattice *lattice = &frame->lattice;
    const srp_extent *extent = &frame->extent;
    const double slack = frame->tie; /* a window as large as the model holds it */
    return frame->kind == SRP_LATTICE_WINDOW &&
           !(extent->u_min >= lattice->u0 - 0.5 * lattice->du - slack &&
             extent->v_min >= lattice->v0 - 0.5 * lattice->dv - slack &&
             extent->u_max <= lattice->u0 + (lattice->columns - 0.5) * lattice->du + slack &&
             extent->v_max <= lattice->v0 + (lattice->rows - 0.5) * lattice->dv + slack);
}

bool srp_raster_frame_cuts(const srp_raster_frame *frame, const srp_facet *facet) {
    for (int k = 0; k < 3; ++k) {
        double x = frame->x[facet->v[k]], y = frame->y[facet->v[k]];
        if (!(x >= -0.5 && x <= frame->lattice.columns - 0.5 && y >= -0.5 &&
              y <= frame->lattice.rows - 0.5)) {
            return true;
        }
    }
    return false;
}
