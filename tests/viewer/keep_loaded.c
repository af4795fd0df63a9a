/* SPDX-License-Identifier: Apache-2.0 */
/* Before a sanitized viewer: drivers of OpenGL stay loaded to the end. What they keep in their own
 * variables would else be reported as lost, by nobody, once they are gone. */
int dlclose(void *library);

int dlclose(void *library) {
    (void)library;
    return 0;
}
