// SPDX-License-Identifier: Apache-2.0
#include "Notes.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace srp_plugin {

std::string list_of(const std::vector<std::string> &names) {
    const size_t most = 5;
    std::string list;
    for (size_t i = 0; i < names.size() && i < most; ++i) {
        list += (i > 0 ? ", " : "") + names[i];
    }
    return names.size() > most ? list + ", ..." : list;
}

Notes::Notes(Messages to) : to_(std::move(to)) {
}

Notes::~Notes() {
    show_waiting();
}

void Notes::show(const std::string &text) const {
    to_(names_.empty() ? text : list_of(names_) + ": " + text);
}

void Notes::show_waiting() {
    for (const std::string &text : waiting_) {
        show(text);
    }
    waiting_.clear();
}

void Notes::add(const std::string &text) {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (!said_.insert(text).second) {
        return;
    }
    if (names_.empty()) {
        waiting_.push_back(text);
    } else {
        show(text);
    }
}

void Notes::concern(const std::vector<std::string> &names) {
    const std::lock_guard<std::mutex> guard(mutex_);
    for (const std::string &name : names) {
        if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
            names_.push_back(name);
        }
    }
    show_waiting();
}

void Notes::flush() {
    const std::lock_guard<std::mutex> guard(mutex_);
    show_waiting();
}

} // namespace srp_plugin
