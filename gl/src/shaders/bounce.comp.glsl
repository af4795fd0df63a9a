// SPDX-License-Identifier: Apache-2.0
// Reflected light of one direction: the estimator of srpcore/src/bounce.c, in float.
//
// Each sample has `slots` invocations: one that follows its mirrored light and what scatters from
// there, and one for each ray that carries the diffuse light of its first hit. Each writes its own
// sums; nothing is added across invocations, so that no order of theirs shows in the result.
//
// Lengths are in unit space (bvh_internal.h), fluxes in cells of the lattice.
//
// The prelude defines STACK, the numbers that the deepest search may put aside, and STORAGE where
// buffers are read as storage, else as textures.

layout(local_size_x = 64) in;

#ifdef STORAGE
#define BUFFER(place, name) \
    layout(std430, binding = place) readonly buffer name##_buffer { uvec4 name##_data[]; }
#define FETCH(name, k) name##_data[k]
#else
#define BUFFER(place, name) layout(binding = place) uniform usamplerBuffer name##_data
#define FETCH(name, k) texelFetch(name##_data, int(k))
#endif

BUFFER(1, nodes);   // 14 each: lower and upper bounds of x, y, z of 8 children, the children
BUFFER(2, blocks);  // 22 each: 3 axes of 3 vertices of 8 facets, room for rounding, the facets
BUFFER(3, facets);  // 3 each: see facet_at()
BUFFER(4, guides);  // cumulated shares, 21 each
BUFFER(5, points);  // 10 for each coordinate of a bounce: 3 steps, 16 bases, 64 bits each
BUFFER(6, samples); // 2 each: place and facet; column, row, back

layout(std430, binding = 0) writeonly buffer sums_buffer { vec4 sums[]; }; // 4 per invocation

uniform uint sample_count;
uniform uint slots;
uniform uint diffuse;
uniform uint reflections;
uniform vec3 sun_ray; // direction in which sunlight travels

const uint BLOCK = 0x80000000u;
const uint NOTHING = 0xffffffffu;
const float FAR = 3.0e38;

const int ACROSS = 0, AROUND = 1, CHOICE = 2, COORDINATES = 3;

vec4 floats(uvec4 bits) {
    return uintBitsToFloat(bits);
}

// ---- facets ----

struct Facet {
    vec3 normal; // outward
    vec3 inner;  // the centre of the circle within
    float pull;  // share of the way to there that starts are moved
    float rho_s, rho_d;
    uvec2 guide; // of front and back
    bool sees;   // anything, from the side in question
};

const uint SEES_FRONT = 1u, SEES_BACK = 2u, ONE_SIDED = 4u;

// One side of a facet; of one-sided ones the back is black.
Facet facet_at(uint k, bool back) {
    vec4 a = floats(FETCH(facets, 3u * k));
    vec4 b = floats(FETCH(facets, 3u * k + 1u));
    uvec4 c = FETCH(facets, 3u * k + 2u);
    bool black = back && (c.z & ONE_SIDED) != 0u;
    Facet facet;
    facet.normal = a.xyz;
    facet.pull = a.w;
    facet.inner = b.xyz;
    facet.rho_s = black ? 0.0 : b.w;
    facet.rho_d = black ? 0.0 : uintBitsToFloat(c.w);
    facet.guide = c.xy;
    facet.sees = (c.z & (back ? SEES_BACK : SEES_FRONT)) != 0u;
    return facet;
}

// ---- rays ----

struct Ray {
    vec3 origin; // moved: clear of its own facet's plane and edges
    vec3 moved;  // by this
    vec3 direction;
    uint from;
    int kx, ky, kz; // a cyclic order of axes, kz that of the longest component
    float shear_x, shear_y, up, per_z;
};

Ray ray_of(vec3 origin, vec3 direction, uint from, Facet leaving) {
    Ray ray;
    ray.origin = origin + leaving.pull * (leaving.inner - origin);
    ray.origin += (dot(leaving.normal, direction) < 0.0 ? -LIFT : LIFT) * leaving.normal;
    ray.moved = ray.origin - origin;
    ray.direction = direction;
    ray.from = from;
    vec3 size = abs(direction);
    ray.kz = size.y > size.x ? (size.z > size.y ? 2 : 1) : (size.z > size.x ? 2 : 0);
    ray.kx = (ray.kz + 1) % 3;
    ray.ky = (ray.kz + 2) % 3;
    ray.per_z = 1.0 / direction[ray.kz];
    ray.shear_x = direction[ray.kx] * ray.per_z;
    ray.shear_y = direction[ray.ky] * ray.per_z;
    ray.up = direction[ray.kz] < 0.0 ? -1.0 : 1.0;
    return ray;
}

struct Hit {
    float z;    // along the axis kz of the ray; FAR: none
    uint facet;
    bool back;
};

// Woop, Benthin & Wald (2013), as in srpcore/src/bvh_facet.c: the difference of two rounded products
// never has the wrong sign, and neighbours agree on which side of their edge a ray passes. `precise`
// keeps compilers from fusing a product with the difference.
void test_block(uint block, Ray ray, inout Hit hit) {
    float ox = ray.origin[ray.kx], oy = ray.origin[ray.ky], oz = ray.origin[ray.kz];
    for (uint part = 0u; part < 2u; ++part) {
        uint at = 22u * block + part;
        uvec4 ids = FETCH(blocks, at + 20u);
        precise vec4 x[3], y[3], z[3];
        for (uint v = 0u; v < 3u; ++v) {
            z[v] = floats(FETCH(blocks, at + 6u * uint(ray.kz) + 2u * v)) - oz;
            x[v] = floats(FETCH(blocks, at + 6u * uint(ray.kx) + 2u * v)) - ox;
            y[v] = floats(FETCH(blocks, at + 6u * uint(ray.ky) + 2u * v)) - oy;
            precise vec4 shift_x = ray.shear_x * z[v], shift_y = ray.shear_y * z[v];
            x[v] = x[v] - shift_x;
            y[v] = y[v] - shift_y;
        }
        precise vec4 u0 = x[1] * y[2], u1 = y[1] * x[2], v0 = x[2] * y[0], v1 = y[2] * x[0];
        precise vec4 w0 = x[0] * y[1], w1 = y[0] * x[1];
        precise vec4 u = u0 - u1, v = v0 - v1, w = w0 - w1;
        vec4 least = min(u, min(v, w)), most = max(u, max(v, w));
        vec4 area = u + v + w;
        vec4 along = ray.up * (u * z[0] + v * z[1] + w * z[2]) / area;
        for (int k = 0; k < 4; ++k) {
            bool inside = !(least[k] < 0.0 && most[k] > 0.0) && area[k] != 0.0;
            bool other = ids[k] != NOTHING && ids[k] != ray.from;
            bool nearer = along[k] < hit.z || (along[k] == hit.z && ids[k] < hit.facet);
            if (inside && other && along[k] > 0.0 && nearer) {
                hit.z = along[k];
                hit.facet = ids[k];
                hit.back = (area[k] < 0.0) == (ray.up < 0.0);
            }
        }
    }
}

// Boxes are padded for float, see srpcore/src/bvh_trace.c.
Hit trace(Ray ray) {
    uint stack_child[STACK];
    float stack_near[STACK];
    int top = 0;
    Hit hit = Hit(FAR, NOTHING, false);
    vec3 d = ray.direction * abs(ray.per_z);
    vec3 tiny = mix(vec3(1.0e-12), vec3(-1.0e-12), lessThan(d, vec3(0.0)));
    d = mix(d, tiny, lessThan(abs(d), vec3(1.0e-12)));
    vec3 inverse = 1.0 / d, offset = ray.origin * inverse;
    uint child = 0u;
    for (;;) {
        if ((child & BLOCK) != 0u) {
            test_block(child & ~BLOCK, ray, hit);
        } else {
            uint next = NOTHING;
            float next_near = FAR;
            for (uint part = 0u; part < 2u; ++part) {
                uint at = 14u * child + part;
                vec4 x0 = floats(FETCH(nodes, at)) * inverse.x - offset.x;
                vec4 x1 = floats(FETCH(nodes, at + 2u)) * inverse.x - offset.x;
                vec4 y0 = floats(FETCH(nodes, at + 4u)) * inverse.y - offset.y;
                vec4 y1 = floats(FETCH(nodes, at + 6u)) * inverse.y - offset.y;
                vec4 z0 = floats(FETCH(nodes, at + 8u)) * inverse.z - offset.z;
                vec4 z1 = floats(FETCH(nodes, at + 10u)) * inverse.z - offset.z;
                uvec4 ids = FETCH(nodes, at + 12u);
                vec4 enter = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), vec4(0.0)));
                vec4 leave = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), vec4(hit.z)));
                for (int k = 0; k < 4; ++k) {
                    if (ids[k] != 0u && enter[k] <= leave[k]) {
                        // The nearest is visited next, the others are put aside.
                        bool first = enter[k] < next_near;
                        uint aside = first ? next : ids[k];
                        float aside_near = first ? next_near : enter[k];
                        next = first ? ids[k] : next;
                        next_near = first ? enter[k] : next_near;
                        if (aside != NOTHING) {
                            stack_child[top] = aside;
                            stack_near[top] = aside_near;
                            ++top;
                        }
                    }
                }
            }
            if (next != NOTHING) {
                child = next;
                continue;
            }
        }
        do {
            if (top == 0) {
                return hit;
            }
            --top;
        } while (stack_near[top] > hit.z);
        child = stack_child[top];
    }
}

// Where the ray meets the plane of the facet that it hits, from the start as it was given, not as it
// was moved; nearly along the plane that is a long way, and rounding would make it anywhere.
vec3 place_of(Ray ray, Hit hit, vec3 normal) {
    float t = hit.z * abs(ray.per_z), rate = dot(normal, ray.direction);
    vec3 correction = vec3(0.0);
    if (abs(rate) > 0.01) {
        correction = dot(normal, ray.moved) / rate * ray.direction - ray.moved;
    }
    return ray.origin + t * ray.direction + correction;
}

// ---- points ----

// sum of base and index times step, modulo 2^64: its upper half
uint advance(uvec2 at, uvec2 step0, uvec2 step1, uvec2 step2, uvec3 index) {
    uvec2 steps[3] = uvec2[3](step0, step1, step2);
    for (int k = 0; k < 3; ++k) {
        uint high, low, carry;
        umulExtended(index[k], steps[k].x, high, low);
        high += index[k] * steps[k].y;
        at.x = uaddCarry(at.x, low, carry);
        at.y += high + carry;
    }
    return at.y;
}

float coordinate(uvec2 place, uint ray, uint bounces, int which) {
    uint at = 10u * (uint(COORDINATES) * bounces + uint(which));
    uvec4 a = FETCH(points, at), b = FETCH(points, at + 1u);
    uint group = (place.y % 4u) * 4u + place.x % 4u;
    uvec4 bases = FETCH(points, at + 2u + group / 2u);
    uvec2 base = group % 2u == 0u ? bases.xy : bases.zw;
    uint high = advance(base, a.xy, a.zw, b.xy, uvec3(place / 4u, ray));
    return float(high >> 8) * (1.0 / 16777216.0);
}

float guide_value(uint map, uint k) {
    return uintBitsToFloat(FETCH(guides, 21u * map + k / 4u)[k % 4u]);
}

// Moves x so that each interval is met in proportion to its share; returns which.
uint move(uint map, uint begin, inout float x, inout float weight) {
    uint k = 0u;
    while (k < 7u && x >= guide_value(map, begin + k + 1u)) {
        ++k;
    }
    float low = guide_value(map, begin + k);
    float share = guide_value(map, begin + k + 1u) - low;
    x = (float(k) + min((x - low) / share, 0.99999994)) / 8.0;
    weight /= share * 8.0;
    return k;
}

// Cosine and sine of 2 pi x, x in [0, 1): the same for all drivers, whose own differ.
vec2 circle(float x) {
    float quarter = floor(4.0 * x + 0.5);
    float a = (4.0 * x - quarter) * 1.5707963267948966, a2 = a * a;
    float s = a * (1.0 + a2 * (-1.6666667e-1 + a2 * (8.3333310e-3 + a2 * (-1.9840874e-4 +
              a2 * 2.7525562e-6))));
    float c = 1.0 + a2 * (-0.5 + a2 * (4.1666638e-2 + a2 * (-1.3888378e-3 + a2 * 2.4760495e-5)));
    int turn = int(quarter) & 3;
    vec2 at = (turn & 1) == 0 ? vec2(c, s) : vec2(-s, c);
    return (turn & 2) == 0 ? at : -at;
}

// A scattered direction and its weight (srpcore/src/guide.c).
vec3 scatter(Facet facet, bool back, uvec2 place, uint ray, uint bounces, out float weight) {
    float across = coordinate(place, ray, bounces, ACROSS);
    float around = coordinate(place, ray, bounces, AROUND);
    uint map = back ? facet.guide.y : facet.guide.x;
    weight = 1.0;
    if (map != NOTHING) {
        uint row = move(map, 0u, across, weight);
        move(map, 9u + 9u * row, around, weight);
    }
    vec3 n = back ? -facet.normal : facet.normal;
    vec2 disc = sqrt(across) * circle(around);
    float side = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + n.z), b = n.x * n.y * a;
    vec3 u = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 v = vec3(b, side + n.y * n.y * a, -n.y);
    return sqrt(1.0 - across) * n + disc.x * u + disc.y * v;
}

vec3 mirror(vec3 direction, vec3 normal) {
    return direction - 2.0 * dot(direction, normal) * normal;
}

// ---- paths ----

void main() {
    uint invocation = gl_GlobalInvocationID.x;
    if (invocation >= sample_count * slots) {
        return;
    }
    uint number = invocation / slots, slot = invocation % slots;
    uvec4 a = FETCH(samples, 2u * number), b = FETCH(samples, 2u * number + 1u);
    vec3 point = uintBitsToFloat(a.xyz), direction = sun_ray;
    uint at = a.w, bounces = 0u, ray = slot == 0u ? 0u : slot - 1u, rays = 0u;
    uvec2 place = b.xy;
    bool back = b.z != 0u, scattered = slot > 0u, going = true;
    Facet facet = facet_at(at, back);
    float flux = 0.0, weight = 1.0;
    float mirrors_lost = 0.0, diffuse_lost = 0.0; // flux that is not followed any more
    vec3 mirrors_f = vec3(0.0), mirrors_t = vec3(0.0), diffuse_f = vec3(0.0), diffuse_t = vec3(0.0);

    // The first bounce.
    float followed = facet.rho_s + (diffuse > 0u ? facet.rho_d : 0.0);
    if (reflections == 0u) {
        mirrors_lost = scattered ? 0.0 : followed;
        going = false;
    } else if (scattered) {
        going = facet.rho_d > 0.0;
        direction = scatter(facet, back, place, ray, 0u, weight);
        flux = weight * facet.rho_d / float(diffuse);
    } else {
        going = facet.rho_s > 0.0;
        direction = mirror(direction, facet.normal);
        flux = facet.rho_s;
    }

    // Where mirrored light goes on when what was scattered from it has been followed.
    bool waiting = false;
    vec3 waiting_point = vec3(0.0), waiting_direction = vec3(0.0);
    float waiting_flux = 0.0;
    uint waiting_at = 0u, waiting_bounces = 0u;

    while (going) {
        Ray path = ray_of(point, direction, at, facet);
        Hit hit = trace(path);
        ++rays;
        going = false;
        if (hit.facet != NOTHING) {
            at = hit.facet;
            back = hit.back;
            facet = facet_at(at, back);
            point = place_of(path, hit, facet.normal);
            ++bounces;
            vec3 n = back ? -facet.normal : facet.normal;
            float inwards = 2.0 * (facet.rho_s * abs(dot(n, direction)) + facet.rho_d / 3.0);
            vec3 push = flux * ((1.0 - facet.rho_s) * direction - inwards * n);
            if (scattered) {
                diffuse_f += push;
                diffuse_t += cross(point, push);
            } else {
                mirrors_f += push;
                mirrors_t += cross(point, push);
            }
            followed = facet.rho_s + (diffuse > 0u ? facet.rho_d : 0.0);
            if (followed > 0.0 && facet.sees) {
                if (bounces == reflections) {
                    mirrors_lost += scattered ? 0.0 : flux * followed;
                    diffuse_lost += scattered ? flux * followed : 0.0;
                } else if (!scattered) {
                    bool splits = diffuse > 0u && facet.rho_d > 0.0;
                    vec3 mirrored = mirror(direction, n);
                    if (splits) {
                        waiting = facet.rho_s > 0.0;
                        waiting_point = point;
                        waiting_direction = mirrored;
                        waiting_flux = flux * facet.rho_s;
                        waiting_at = at;
                        waiting_bounces = bounces;
                        direction = scatter(facet, back, place, ray, bounces, weight);
                        flux *= facet.rho_d * weight;
                        scattered = true;
                        going = true;
                    } else {
                        direction = mirrored;
                        flux *= facet.rho_s;
                        going = true;
                    }
                } else {
                    flux *= followed;
                    if (coordinate(place, ray, bounces, CHOICE) * followed < facet.rho_s) {
                        direction = mirror(direction, n);
                    } else {
                        direction = scatter(facet, back, place, ray, bounces, weight);
                        flux *= weight;
                    }
                    going = true;
                }
            }
        }
        if (!going && waiting) {
            point = waiting_point;
            direction = waiting_direction;
            flux = waiting_flux;
            at = waiting_at;
            bounces = waiting_bounces;
            facet = facet_at(at, false);
            scattered = false;
            waiting = false;
            going = true;
        }
    }
    sums[4u * invocation] = vec4(mirrors_f, mirrors_lost);
    sums[4u * invocation + 1u] = vec4(mirrors_t, float(rays));
    sums[4u * invocation + 2u] = vec4(diffuse_f, diffuse_lost);
    sums[4u * invocation + 3u] = vec4(diffuse_t, 0.0);
}
