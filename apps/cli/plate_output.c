/* SPDX-License-Identifier: Apache-2.0 */
#include "plate_output.h"

#include "numbers.h"

#include <math.h>

static size_t with_area(const srp_plate *plates, size_t count) {
    size_t some = 0;
    for (size_t k = 0; k < count; ++k) {
        some += plates[k].area > 0.0;
    }
    return some;
}

static void put(FILE *out, double value, const char *behind) {
    char text[CLI_NUMBER_SIZE];
    fprintf(out, "%s%s", cli_write_number(value, text), behind);
}

void cli_plates_write(FILE *out, const srp_plate *plates, size_t count, const char *about) {
    fprintf(out, "%zu\n# %s\n# nx ny nz area[m^2] rho_s rho_d\n", with_area(plates, count), about);
    for (size_t k = 0; k < count; ++k) {
        if (plates[k].area > 0.0) {
            put(out, plates[k].normal.x, " ");
            put(out, plates[k].normal.y, " ");
            put(out, plates[k].normal.z, " ");
            put(out, plates[k].area, " ");
            put(out, plates[k].optics.rho_s, " ");
            put(out, plates[k].optics.rho_d, "\n");
        }
    }
}

/* The names of all plates that are there, with `between` between them. */
static void put_names(FILE *out, const srp_plate *plates, size_t count, const char *between) {
    size_t n = 0;
    for (size_t k = 0; k < count; ++k) {
        if (plates[k].area > 0.0) {
            fprintf(out, "%sPlate%zu", n > 0 ? between : "", n + 1);
            ++n;
        }
    }
}

static void put_plate(FILE *out, const srp_plate *plate, size_t number) {
    fprintf(out, "\nPlate%zu.Type = FixedInBody;\nPlate%zu.PlateNormal = [", number, number);
    put(out, plate->normal.x, " ");
    put(out, plate->normal.y, " ");
    put(out, plate->normal.z, "];\n");
    fprintf(out, "Plate%zu.Area = ", number);
    put(out, plate->area, ";\n");
    fprintf(out, "Plate%zu.AreaCoefficient = 1;\nPlate%zu.LitFraction = 1;\n", number, number);
    fprintf(out, "Plate%zu.SpecularFraction = ", number);
    put(out, plate->optics.rho_s, ";\n");
    fprintf(out, "Plate%zu.DiffuseFraction = ", number);
    put(out, plate->optics.rho_d, ";\n");
}

void cli_plates_write_gmat(FILE *out, const srp_plate *plates, size_t count, const char *about,
                           double mass, srp_sunlight light) {
    fprintf(out,
            "%% %s\n"
            "%% For GMAT R2022a and later. The plates are fixed in the body axes of the "
            "spacecraft.\n"
            "\nCreate Spacecraft Sat;\n",
            about);
    if (!isnan(mass)) {
        fputs("Sat.DryMass = ", out);
        put(out, mass, ";\n");
    }
    fputs("\nCreate Plate ", out);
    put_names(out, plates, count, " ");
    fputs(";\n", out);
    for (size_t k = 0, number = 0; k < count; ++k) {
        if (plates[k].area > 0.0) {
            put_plate(out, &plates[k], ++number);
        }
    }
    fputs("\nSat.AddPlates = {", out);
    put_names(out, plates, count, ", ");
    fputs("};\n\nCreate ForceModel FM;\nFM.CentralBody = Earth;\nFM.PointMasses = {Earth, Sun, "
          "Luna};\nFM.Drag = None;\nFM.SRP = On;\nFM.SRP.SRPModel = NPlate;\nFM.SRP.Flux = ",
          out);
    put(out, light.flux, ";\nFM.SRP.Nominal_Sun = ");
    put(out, light.au / 1000.0, ";\n");
    fputs("\nCreate Propagator Prop;\nProp.FM = FM;\n\nBeginMissionSequence;\n"
          "Propagate Prop(Sat) {Sat.ElapsedSecs = 60};\n",
          out);
}
