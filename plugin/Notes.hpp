// SPDX-License-Identifier: Apache-2.0
// What a force has to say beside its errors: each thing once, however many copies GMAT makes, and
// with the names of the spacecraft that it is about. These are not known when a model is read, so
// that what is said then waits for them. Knows no GMAT.
#ifndef SRP_PLUGIN_NOTES_HPP
#define SRP_PLUGIN_NOTES_HPP

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace srp_plugin {

// Where warnings and notes go, a line each.
using Messages = std::function<void(const std::string &)>;

class Notes {
  public:
    explicit Notes(Messages to);
    ~Notes(); // what still waits is shown without a name
    Notes(const Notes &) = delete;
    Notes &operator=(const Notes &) = delete;

    void add(const std::string &text);
    // Spacecraft that the notes are about, besides those that it has; shows what waits.
    void concern(const std::vector<std::string> &names);
    // Shows what waits, as the names will not be known.
    void flush();

  private:
    void show(const std::string &text) const;
    void show_waiting();

    std::mutex mutex_;
    Messages to_;
    std::vector<std::string> names_, waiting_;
    std::set<std::string> said_;
};

// "A, B": at most a handful of names. "" for none.
std::string list_of(const std::vector<std::string> &names);

} // namespace srp_plugin

#endif
