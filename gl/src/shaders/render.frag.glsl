// SPDX-License-Identifier: Apache-2.0
// What a facet, its lit part, an edge or an arrow looks like.

flat in vec3 across;
flat in uint painted;

// Colours of facets, so many to a row.
uniform sampler2D colours;
const uint ROW = 1024u;
// Bit of `paint` that says: the rest is a colour itself, 8 bits each of red, green, blue.
const uint IS_COLOUR = 0x80000000u;

uniform vec4 eye;   // unit vector to the eye
uniform vec4 sun;   // unit vector to the Sun
uniform float lit;  // 1: sunlight falls on it; 2: where the side that is seen is the Sun's
uniform float data; // 1: colours stand for values, and lit ones are kept as they are
uniform float opacity;

out vec4 colour;

vec3 own_colour() {
    if ((painted & IS_COLOUR) != 0u) {
        return vec3(uvec3(painted >> 16u, painted >> 8u, painted) & 255u) / 255.0;
    }
    return texelFetch(colours, ivec2(painted % ROW, painted / ROW), 0).rgb;
}

bool is_lit() {
    return lit > 1.5 ? dot(across, sun.xyz) * dot(across, eye.xyz) > 0.0 : lit > 0.5;
}

void main() {
    vec3 own = own_colour();
    float seen = abs(dot(across, eye.xyz));
    if (across == vec3(0.0)) {
        colour = vec4(own, opacity);
    } else if ((painted & IS_COLOUR) != 0u) {
        colour = vec4(own * (0.65 + 0.35 * seen), opacity);
    } else if (is_lit()) {
        float shade = 0.55 + 0.45 * abs(dot(across, sun.xyz));
        colour = vec4(own * mix(shade, 1.0, data), opacity);
    } else {
        // In shadow: dark, but for the form; beside values, grey, which no map of colours has.
        vec3 dark = mix(own, vec3(dot(own, vec3(0.3, 0.5, 0.2))), 0.35) * (0.16 + 0.16 * seen);
        colour = vec4(mix(dark, vec3(0.26 + 0.16 * seen), data), opacity);
    }
}
