// SPDX-License-Identifier: Apache-2.0
// Vertices over the samples of a lattice, laid over a picture. They come projected: differences of
// coordinates that are large beside the picture were taken in double precision.

layout(location = 0) in vec3 position; // samples along x and y; depth within [-1, 1], -1 nearest

uniform vec2 middle; // of the picture [samples]
uniform vec2 scale;  // coordinates of the target per sample

invariant gl_Position;

void main() {
    gl_Position = vec4(scale * (position.xy - middle), position.z, 1.0);
}
