/* SPDX-License-Identifier: Apache-2.0 */
/* The models, each a function that writes its files into `directory`. models/README.md describes
 * them. */
#ifndef MODELS_MODELS_H
#define MODELS_MODELS_H

void make_cube(const char *directory);
void make_icospheres(const char *directory);
void make_l_corner(const char *directory);
void make_dihedral(const char *directory);
void make_box_wing(const char *directory);
void make_dish(const char *directory);
void make_sun_shield(const char *directory);
void make_gnss(const char *directory);

#endif
