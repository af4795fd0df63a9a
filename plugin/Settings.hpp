// SPDX-License-Identifier: Apache-2.0
// The fields of the force as a script sets them: names, types, ranges, defaults. Knows no GMAT.
#ifndef SRP_PLUGIN_SETTINGS_HPP
#define SRP_PLUGIN_SETTINGS_HPP

#include <cstddef>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace srp_plugin {

// A value that the force cannot work with; what() names the field.
class BadSetting : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct Settings {
    // What the light falls on: a table, or a model that is traced.
    std::string table_file;
    std::string obj_file;
    std::string mtl_file;
    double metres_per_unit = 1.0;
    // How it is traced.
    std::string method = "exact";
    int grid = 512; // samples along the longer side of the silhouette
    int reflections = 2;
    int diffuse = 0;
    double azimuth_step_deg = 1.0;
    double elevation_step_deg = 1.0;
    bool on_demand = true;
    bool cache = true;
    std::string cache_directory;
    int threads = 0; // 0: one for each processor
    // What is made of it.
    std::string interpolation = "bicubic";
    double max_error = 0.01; // of f over the largest |f|; above it a warning
    double scale = 1.0;
    double flux = 1367.0;         // [W/m^2]
    double au_km = 149597870.691; // GMAT's Nominal_Sun
    std::string shadow_bodies = "CentralBody";
};

struct Field {
    const char *name; // as scripts write it
    std::variant<double Settings::*, int Settings::*, bool Settings::*, std::string Settings::*>
        member;
    double low, high; // of numbers; `low` itself is allowed when low_allowed
    bool low_allowed;
    const char *words; // of texts: what is allowed, with blanks between; nullptr: anything
    bool is_file;
};

// All fields, in the order in which they are saved.
const std::vector<Field> &fields();

// Throw BadSetting when the value is out of its range; `settings` is then as before.
void set_number(Settings &settings, const Field &field, double value);
void set_integer(Settings &settings, const Field &field, int value);
void set_text(Settings &settings, const Field &field, const std::string &value);

// Throws BadSetting unless the fields fit together.
void check(const Settings &settings);

// The names in a list of bodies: `Earth, Luna`, also in braces.
std::vector<std::string> names_in(const std::string &list);

} // namespace srp_plugin

#endif
