// SPDX-License-Identifier: Apache-2.0
// The area vector over all directions, as the settings ask for it: a table that is read, or a model
// that is traced, at once or on demand. Knows no GMAT.
#ifndef SRP_PLUGIN_AREA_MODEL_HPP
#define SRP_PLUGIN_AREA_MODEL_HPP

#include "Notes.hpp"
#include "Settings.hpp"

#include <srp/acceleration.h>
#include <srp/cache.h>
#include <srp/demand.h>
#include <srp/interp.h>
#include <srp/material.h>
#include <srp/method.h>
#include <srp/scene.h>
#include <srp/spad.h>
#include <srp/table.h>

#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace srp_plugin {

// What srpcore says about an error: place, what was found, what was expected, which field helps.
std::string words_of(const srp_error &error);

struct Release {
    void operator()(srp_scene *x) const {
        srp_scene_destroy(x);
    }
    void operator()(srp_materials *x) const {
        srp_materials_destroy(x);
    }
    void operator()(srp_prepared *x) const {
        srp_prepared_release(x);
    }
    void operator()(srp_cache *x) const {
        srp_cache_close(x);
    }
    void operator()(srp_table *x) const {
        srp_table_destroy(x);
    }
    void operator()(srp_demand *x) const {
        srp_demand_destroy(x);
    }
    void operator()(srp_interp *x) const {
        srp_interp_destroy(x);
    }
    void operator()(srp_spad *x) const {
        srp_spad_destroy(x);
    }
};
template <typename T>
using Owned = std::unique_ptr<T, Release>;

// Read-only once it is made; any number of threads may look up.
class AreaModel {
  public:
    // Paths in `settings` are those to open. Throws BadSetting.
    AreaModel(const Settings &settings, Messages messages);
    ~AreaModel();
    AreaModel(const AreaModel &) = delete;
    AreaModel &operator=(const AreaModel &) = delete;

    srp_area_source source() const {
        return spad_ ? srp_area_source_spad(spad_.get()) : srp_area_source_interp(interp_.get());
    }

  private:
    void read_table(const Settings &settings);
    void read_scene(const Settings &settings);
    void prepare(const Settings &settings);
    void open_cache(const Settings &settings);
    void trace_on_demand(const Settings &settings, srp_grid grid);
    void trace_at_once(const Settings &settings, srp_grid grid);
    void interpolate(const Settings &settings, const srp_table *table, const char *field);
    void warn_of_sampling(double largest, double sampling) const;
    void warn_of_table(const Settings &settings, const srp_table *table) const;
    void tell_of_demand() const;
    static void forward(void *user, const srp_error *what);
    srp_log log();

    Messages messages_;
    std::string name_;
    double max_error_;
    // Destroyed in the opposite order.
    Owned<srp_scene> scene_;
    Owned<srp_prepared> prepared_;
    Owned<srp_cache> cache_;
    Owned<srp_demand> demand_;
    Owned<srp_interp> interp_;
    Owned<srp_spad> spad_; // instead of interp_, for GMAT's own look-up
};

// What a force and all its copies have in common: the model is made when the first of them needs
// it, and made anew when a file has changed.
class SharedModel {
  public:
    explicit SharedModel(Messages to) : notes_(std::make_shared<Notes>(std::move(to))) {
    }
    // Throws BadSetting.
    std::shared_ptr<const AreaModel> get(const Settings &settings);
    Notes &notes() {
        return *notes_;
    }

  private:
    std::mutex mutex_;
    std::shared_ptr<Notes> notes_; // also of the models, which say how it went at their end
    std::string key_;
    std::shared_ptr<const AreaModel> model_;
};

} // namespace srp_plugin

#endif
