// SPDX-License-Identifier: Apache-2.0
#include "AreaModel.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

namespace srp_plugin {

std::string words_of(const srp_error &error) {
    char text[1400];
    srp_error_format(&error, text, sizeof text);
    return std::string(text) +
           (error.remedy == SRP_REMEDY_OPTICS ? " or in one that SRPMtlFile names" : "");
}

namespace {

[[noreturn]] void fail(const char *field, const srp_error &error) {
    throw BadSetting(std::string(field) + ": " + words_of(error));
}

srp_method_params params_of(const Settings &settings) {
    srp_method_params params = srp_method_params_default();
    if (settings.threads > 0) {
        params.threads = settings.threads;
    }
    params.lattice.samples = uint32_t(settings.grid);
    params.reflections = uint32_t(settings.reflections);
    params.diffuse = uint32_t(settings.diffuse);
    return params;
}

const srp_method *method_of(const std::string &name) {
    size_t count;
    const srp_method *const *methods = srp_method_list(&count);
    const auto *found = std::find_if(
        methods, methods + count, [&](const srp_method *method) { return name == method->name; });
    if (found == methods + count) {
        throw BadSetting("SRPMethod: there is no method '" + name + "'");
    }
    return *found;
}

// Largest |f| and largest standard error of f of the nodes that `get` knows.
template <typename Get>
std::pair<double, double> extremes(srp_grid grid, Get get) {
    double largest = 0.0, error = 0.0;
    for (uint32_t i = 0; i < grid.az_count; ++i) {
        for (uint32_t j = 0; j < grid.el_count; ++j) {
            if (const srp_response *node = get(i, j)) {
                largest = std::max(largest, srp_vec3_norm(node->f));
                error = std::max(error, node->f_error);
            }
        }
    }
    return {largest, error};
}

std::string percent(double share) {
    std::ostringstream text;
    text.precision(3);
    text << 100.0 * share << " %";
    return text.str();
}

} // namespace

void AreaModel::forward(void *user, const srp_error *what) {
    static_cast<AreaModel *>(user)->messages_(words_of(*what));
}

srp_log AreaModel::log() {
    return {forward, this};
}

AreaModel::AreaModel(const Settings &settings, Messages messages)
    : messages_(std::move(messages)), max_error_(settings.max_error) {
    check(settings);
    if (!settings.table_file.empty()) {
        name_ = settings.table_file;
        read_table(settings);
    } else {
        name_ = settings.obj_file;
        read_scene(settings);
        prepare(settings);
    }
}

AreaModel::~AreaModel() {
    if (demand_) {
        tell_of_demand();
    }
}

void AreaModel::read_table(const Settings &settings) {
    srp_error error;
    const char *path = settings.table_file.c_str();
    const srp_table_format *format = srp_table_format_of(path);
    if (format == nullptr) {
        throw BadSetting("SRPTableFile: '" + settings.table_file +
                         "' is no name of a table, expected .nc or .spo");
    }
    srp_table *read = nullptr;
    if (srp_table_read(format, path, &read, &error) != SRP_OK) {
        fail("SRPTableFile", error);
    }
    const Owned<srp_table> table(read);
    if (!srp_table_is_complete(table.get())) {
        throw BadSetting("SRPTableFile: " + settings.table_file + ": the table is not complete");
    }
    if (srp_table_pull_share(table.get()) > SRP_TABLE_PULL_LIMIT) {
        throw BadSetting("SRPTableFile: " + settings.table_file +
                         ": its forces pull towards the Sun: it follows the opposite sign "
                         "convention, srp convert --flip turns it round");
    }
    interpolate(settings, table.get(), "SRPTableFile");
    if (interp_) { // GMAT's own look-up takes every node as it is
        const srp_log to = log();
        srp_table_inspect(table.get(), path, &to, nullptr);
    }
    warn_of_table(settings, table.get());
}

// GMAT's own look-up is called by the names of ours, with "gmat_" before them.
void AreaModel::interpolate(const Settings &settings, const srp_table *table, const char *field) {
    srp_error error;
    srp_interp *interp = nullptr;
    srp_spad *spad = nullptr;
    const std::string &name = settings.interpolation;
    const srp_interp_scheme *scheme = srp_interp_find(name.c_str());
    const srp_status status = scheme != nullptr
                                  ? srp_interp_create(scheme, table, &interp, &error)
                                  : srp_spad_create(table, name == "gmat_bicubic", &spad, &error);
    if (status != SRP_OK) {
        throw BadSetting(std::string(field) + ": " + name_ + ": " + words_of(error));
    }
    interp_.reset(interp);
    spad_.reset(spad);
}

void AreaModel::warn_of_sampling(double largest, double sampling) const {
    if (sampling > max_error_ * largest) {
        messages_(name_ + ": the sampling error reaches " + percent(sampling / largest) +
                  " of the largest force, above SRPMaxError");
    }
}

void AreaModel::warn_of_table(const Settings &settings, const srp_table *table) const {
    const auto [largest, sampling] = extremes(
        srp_table_grid(table), [&](uint32_t i, uint32_t j) { return srp_table_node(table, i, j); });
    const srp_table_info *info = srp_table_get_info(table);
    if (info->has_error) {
        warn_of_sampling(largest, sampling);
    }
    size_t count;
    const srp_interp_scheme *const *schemes = srp_interp_list(&count);
    for (size_t k = 0; info->check.count > 0 && k < count && k < SRP_TABLE_SCHEMES; ++k) {
        const double off = info->check.errors[k].f_max;
        if (settings.interpolation == schemes[k]->name && off > max_error_ * largest) {
            messages_(name_ + ": the error of " + schemes[k]->name + " interpolation reaches " +
                      percent(off / largest) + " of the largest force, above SRPMaxError");
        }
    }
}

void AreaModel::read_scene(const Settings &settings) {
    srp_error error;
    srp_mesh_read_params params = srp_mesh_read_params_default();
    params.metres_per_unit = settings.metres_per_unit;
    const srp_log to = log();
    Owned<srp_materials> given;
    if (!settings.mtl_file.empty()) {
        srp_materials *made = nullptr;
        if (srp_materials_create(&made, &error) != SRP_OK) {
            fail("SRPMtlFile", error);
        }
        given.reset(made);
        if (srp_materials_read_mtl(made, settings.mtl_file.c_str(), &to, &error) != SRP_OK) {
            fail("SRPMtlFile", error);
        }
    }
    const char *path = settings.obj_file.c_str();
    srp_scene *scene = nullptr;
    if (srp_scene_read_obj(&path, 1, &params, given.get(), &to, &scene, &error) != SRP_OK) {
        fail("SRPObjFile", error);
    }
    scene_.reset(scene);
}

void AreaModel::prepare(const Settings &settings) {
    srp_error error;
    const srp_method_params params = params_of(settings);
    srp_prepared *prepared = nullptr;
    if (srp_method_prepare(method_of(settings.method), scene_.get(), &params, &prepared, &error) !=
        SRP_OK) {
        fail("SRPMethod", error);
    }
    prepared_.reset(prepared);
    srp_grid grid;
    if (srp_grid_from_steps(settings.azimuth_step_deg, settings.elevation_step_deg, &grid,
                            &error) != SRP_OK) {
        fail("SRPAzimuthStep, SRPElevationStep", error);
    }
    if (settings.cache) {
        open_cache(settings);
    }
    if (settings.on_demand) {
        trace_on_demand(settings, grid);
    } else {
        trace_at_once(settings, grid);
    }
}

void AreaModel::open_cache(const Settings &settings) {
    srp_error error;
    srp_cache_params params = srp_cache_params_default();
    if (!settings.cache_directory.empty()) {
        params.directory = settings.cache_directory.c_str();
    }
    const srp_log to = log();
    srp_cache *cache = nullptr;
    if (srp_cache_open(&params, &to, &cache, &error) != SRP_OK) {
        messages_("SRPCacheDirectory: " + words_of(error) + "; the run goes on without the cache");
    }
    cache_.reset(cache);
}

void AreaModel::trace_on_demand(const Settings &settings, srp_grid grid) {
    const srp_interp_scheme *scheme = srp_interp_find(settings.interpolation.c_str());
    srp_error error;
    srp_demand *demand = nullptr;
    srp_interp *interp = nullptr;
    if (srp_demand_create(prepared_.get(), grid, cache_.get(), &demand, &error) != SRP_OK) {
        fail("SRPObjFile", error);
    }
    demand_.reset(demand);
    if (srp_interp_create_on_demand(scheme, demand, &interp, &error) != SRP_OK) {
        fail("SRPInterpolation", error);
    }
    interp_.reset(interp);
}

void AreaModel::trace_at_once(const Settings &settings, srp_grid grid) {
    srp_error error;
    srp_table *made = nullptr;
    if (srp_table_create(prepared_.get(), grid, false, &made, &error) != SRP_OK) {
        fail("SRPObjFile", error);
    }
    const Owned<srp_table> table(made);
    // A cache that does not work stops nobody, and is told of once.
    const auto exchange = [&] {
        if (cache_ && srp_cache_exchange(cache_.get(), prepared_.get(), table.get(), nullptr,
                                         &error) != SRP_OK) {
            messages_("SRPCacheDirectory: " + words_of(error));
            cache_.reset();
        }
    };
    exchange();
    if (!srp_table_is_complete(table.get())) {
        if (srp_table_fill(table.get(), prepared_.get(), nullptr, &error) != SRP_OK) {
            fail("SRPObjFile", error);
        }
        exchange();
    }
    interpolate(settings, table.get(), "SRPInterpolation");
    warn_of_table(settings, table.get());
}

void AreaModel::tell_of_demand() const {
    const srp_demand_counts counts = srp_demand_count(demand_.get());
    std::ostringstream text;
    text << name_ << ": " << counts.computed << " directions traced, " << counts.ready
         << " known of " << counts.total;
    messages_(text.str());
    const srp_demand *demand = demand_.get();
    const auto [largest, sampling] = extremes(srp_demand_grid(demand), [&](uint32_t i, uint32_t j) {
        return srp_demand_get(demand, srp_demand_node{i, j});
    });
    warn_of_sampling(largest, sampling);
}

// ---- Sharing ------------------------------------------------------------------------------------

namespace {

// Of a file that may change between two runs of a session.
void add_file(std::ostream &key, const std::string &path) {
    std::error_code code;
    const std::filesystem::path file(path);
    const auto size = std::filesystem::file_size(file, code);
    key << path << '\n' << (code ? 0 : size) << ' ';
    const auto time = std::filesystem::last_write_time(file, code);
    key << (code ? 0 : time.time_since_epoch().count()) << '\n';
}

std::string key_of(const Settings &s) {
    std::ostringstream key;
    key.precision(17);
    add_file(key, s.table_file);
    add_file(key, s.obj_file);
    add_file(key, s.mtl_file);
    key << s.metres_per_unit << ' ' << s.method << ' ' << s.grid << ' ' << s.reflections << ' '
        << s.diffuse << ' ' << s.azimuth_step_deg << ' ' << s.elevation_step_deg << ' '
        << s.on_demand << s.cache << ' ' << s.cache_directory << '\n'
        << s.threads << ' ' << s.interpolation << ' ' << s.max_error;
    return key.str();
}

} // namespace

std::shared_ptr<const AreaModel> SharedModel::get(const Settings &settings) {
    const std::lock_guard<std::mutex> guard(mutex_);
    std::string key = key_of(settings);
    if (!model_ || key != key_) {
        const std::shared_ptr<Notes> notes = notes_;
        model_ = std::make_shared<const AreaModel>(
            settings, [notes](const std::string &text) { notes->add(text); });
        key_ = std::move(key);
    }
    return model_;
}

} // namespace srp_plugin
