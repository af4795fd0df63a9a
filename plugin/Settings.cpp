// SPDX-License-Identifier: Apache-2.0
#include "Settings.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace srp_plugin {

namespace {

Field number(const char *name, double Settings::*member, double low, double high,
             bool low_allowed) {
    return {name, member, low, high, low_allowed, nullptr, false};
}

Field integer(const char *name, int Settings::*member, int low, int high) {
    return {name, member, double(low), double(high), true, nullptr, false};
}

Field yes_or_no(const char *name, bool Settings::*member) {
    return {name, member, 0.0, 1.0, true, nullptr, false};
}

Field text(const char *name, std::string Settings::*member, const char *words = nullptr) {
    return {name, member, 0.0, 0.0, true, words, false};
}

Field file(const char *name, std::string Settings::*member) {
    return {name, member, 0.0, 0.0, true, nullptr, true};
}

std::vector<Field> make_fields() {
    return {
        file("SRPTableFile", &Settings::table_file),
        file("SRPObjFile", &Settings::obj_file),
        file("SRPMtlFile", &Settings::mtl_file),
        number("SRPUnit", &Settings::metres_per_unit, 0.0, 1e6, false),
        text("SRPMethod", &Settings::method, "exact raycast raytrace"),
        integer("SRPGrid", &Settings::grid, 1, 32768),
        integer("SRPReflections", &Settings::reflections, 0, 100),
        integer("SRPDiffuse", &Settings::diffuse, 0, 1024),
        number("SRPAzimuthStep", &Settings::azimuth_step_deg, 0.01, 180.0, true),
        number("SRPElevationStep", &Settings::elevation_step_deg, 0.01, 180.0, true),
        yes_or_no("SRPOnDemand", &Settings::on_demand),
        yes_or_no("SRPCache", &Settings::cache),
        file("SRPCacheDirectory", &Settings::cache_directory),
        integer("SRPThreads", &Settings::threads, 0, 1024),
        text("SRPInterpolation", &Settings::interpolation,
             "bilinear bicubic spline gmat_bilinear gmat_bicubic"),
        number("SRPMaxError", &Settings::max_error, 0.0, 1e6, true),
        number("SRPScaleFactor", &Settings::scale, 0.0, 1e6, true),
        number("SRPFlux", &Settings::flux, 0.0, 1e6, false),
        number("SRPAstronomicalUnit", &Settings::au_km, 135e6, 165e6, true),
        text("SRPShadowBodies", &Settings::shadow_bodies),
    };
}

// `found VALUE, expected LOW to HIGH`, as the library says it.
void check_range(const Field &field, double value) {
    if (std::isfinite(value) && value <= field.high &&
        (value > field.low || (field.low_allowed && value == field.low))) {
        return;
    }
    std::ostringstream message;
    message.precision(15);
    message << field.name << ": found " << value << ", expected ";
    if (field.low_allowed) {
        message << field.low << " to " << field.high;
    } else {
        message << "above " << field.low << " and at most " << field.high;
    }
    throw BadSetting(message.str());
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

// The one of `words` that `value` is but for small and capital letters, as GMAT writes words of its
// own with a capital; "" for none.
std::string word_of(const std::string &value, const char *words) {
    std::istringstream all(words);
    for (std::string word; all >> word;) {
        if (word.size() == value.size() &&
            std::equal(word.begin(), word.end(), value.begin(),
                       [](char a, char b) { return lower(a) == lower(b); })) {
            return word;
        }
    }
    return "";
}

// Whether a field has another value than it begins with.
bool is_set(const Settings &settings, const Field &field) {
    static const Settings usual;
    return std::visit([&](auto member) { return settings.*member != usual.*member; }, field.member);
}

// Fields that would count for nothing are a misunderstanding. `names`: with blanks between.
void refuse(const Settings &settings, const char *names, const char *reason) {
    for (const Field &field : fields()) {
        if (!word_of(field.name, names).empty() && is_set(settings, field)) {
            throw BadSetting(std::string(field.name) + ": " + reason);
        }
    }
}

void check_unused(const Settings &settings) {
    if (settings.obj_file.empty()) {
        refuse(settings,
               "SRPMtlFile SRPUnit SRPMethod SRPGrid SRPReflections SRPDiffuse SRPAzimuthStep "
               "SRPElevationStep",
               "goes with SRPObjFile, a table is as it was made");
    }
    if (settings.method != "raytrace") {
        refuse(settings, "SRPReflections SRPDiffuse",
               "goes with SRPMethod = raytrace, the only one that follows reflected light");
    }
    if (settings.method == "exact") {
        refuse(settings, "SRPGrid",
               "goes with SRPMethod raycast or raytrace, exact samples nothing");
    }
}

void check_bodies(const Settings &settings) {
    const std::vector<std::string> names = names_in(settings.shadow_bodies);
    const auto has = [&](const char *name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (names.empty() || has("Sun") || (has("None") && names.size() > 1)) {
        throw BadSetting("SRPShadowBodies: found '" + settings.shadow_bodies +
                         "', expected CentralBody, None alone, or names such as 'Earth, Luna', "
                         "without the Sun");
    }
}

} // namespace

const std::vector<Field> &fields() {
    static const std::vector<Field> all = make_fields();
    return all;
}

void set_number(Settings &settings, const Field &field, double value) {
    check_range(field, value);
    settings.*std::get<double Settings::*>(field.member) = value;
}

void set_integer(Settings &settings, const Field &field, int value) {
    check_range(field, value);
    settings.*std::get<int Settings::*>(field.member) = value;
}

void set_text(Settings &settings, const Field &field, const std::string &value) {
    const std::string taken = field.words != nullptr ? word_of(value, field.words) : value;
    if (field.words != nullptr && taken.empty()) {
        throw BadSetting(std::string(field.name) + ": found '" + value + "', expected one of " +
                         field.words);
    }
    settings.*std::get<std::string Settings::*>(field.member) = taken;
}

void check(const Settings &settings) {
    const bool table = !settings.table_file.empty(), model = !settings.obj_file.empty();
    if (table && model) {
        throw BadSetting("SRPTableFile and SRPObjFile exclude each other: a table, or a model that "
                         "is traced");
    }
    if (!table && !model) {
        throw BadSetting("SRPTableFile: not set, expected the name of a table (.nc, .spo), or "
                         "SRPObjFile with that of a model");
    }
    check_unused(settings);
    check_bodies(settings);
    const std::string &scheme = settings.interpolation;
    if (model && settings.on_demand && scheme != "bilinear" && scheme != "bicubic") {
        throw BadSetting("SRPInterpolation: " + scheme +
                         " needs all nodes at once, expected bilinear or bicubic while SRPOnDemand "
                         "is true");
    }
}

std::vector<std::string> names_in(const std::string &list) {
    std::string blanks = list;
    for (char &c : blanks) {
        if (c == ',' || c == '{' || c == '}' || c == ';' || c == '\t') {
            c = ' ';
        }
    }
    std::vector<std::string> names;
    std::istringstream all(blanks);
    for (std::string name; all >> name;) {
        names.push_back(name);
    }
    return names;
}

} // namespace srp_plugin
