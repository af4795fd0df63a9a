// SPDX-License-Identifier: Apache-2.0
// GMAT's base class of forces, with what it needs to be compiled.
#ifndef SRP_PLUGIN_GMAT_FORCE_HPP
#define SRP_PLUGIN_GMAT_FORCE_HPP

// R2026a names it even where CSPICE is left out.
class SpiceOrbitKernelReader;
#include "PhysicalModel.hpp"

#endif
