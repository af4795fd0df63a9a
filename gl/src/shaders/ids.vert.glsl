// SPDX-License-Identifier: Apache-2.0
// Vertices of the scene, turned to the Sun and laid over the samples of a lattice.

layout(location = 0) in vec3 position; // unit space of the scene

// Coordinates of the target and depth: xyz . position + w.
uniform vec4 along_x;
uniform vec4 along_y;
uniform vec4 along_z;

invariant gl_Position;

void main() {
    gl_Position = vec4(dot(along_x.xyz, position) + along_x.w,
                       dot(along_y.xyz, position) + along_y.w,
                       dot(along_z.xyz, position) + along_z.w, 1.0);
}
