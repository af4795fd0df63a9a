// SPDX-License-Identifier: Apache-2.0
// Facets, their lit parts, edges and arrows of a picture.

layout(location = 0) in vec3 position; // unit space of the scene
layout(location = 1) in vec3 normal;   // 0: drawn without shading
layout(location = 2) in uint paint;    // number of the facet, or a colour: see the fragment shader

uniform vec4 rows[4]; // of the matrix from unit space to the picture
uniform float nearer; // by how much of the depth of the picture

flat out vec3 across;
flat out uint painted;

void main() {
    vec4 p = vec4(position, 1.0);
    gl_Position = vec4(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p), dot(rows[3], p));
    gl_Position.z -= nearer * gl_Position.w;
    across = normal;
    painted = paint;
}
