// SPDX-License-Identifier: Apache-2.0
// Which triangle of the draw covers a pixel, counted from `first`; 0 stands for none.

uniform uint first;

out uint id;

void main() {
    id = first + uint(gl_PrimitiveID);
}
