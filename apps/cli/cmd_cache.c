/* SPDX-License-Identifier: Apache-2.0 */
/* srp cache: what the directory of remembered tables holds. */
#include "commands.h"
#include "messages.h"

#include <srp/cache.h>
#include <srp/table.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { CACHE_DIRECTORY, CACHE_OPTION_COUNT };

typedef struct cache_options {
    cli_given given;
    const char *directory;
} cache_options;

static const cli_option OPTIONS[CACHE_OPTION_COUNT] = {
    [CACHE_DIRECTORY] = {.name = "directory",
                         .value = "DIR",
                         .complete = CLI_COMPLETE_FILE,
                         .help = "Another directory than the user's.",
                         .set = cli_set_text,
                         .offset = offsetof(cache_options, directory)},
};

static const cli_group CACHE = {"Cache", OPTIONS, CACHE_OPTION_COUNT};
static const cli_group *const GROUPS[] = {&CACHE};

/* What a file holds, in words. */
static void describe(const srp_cache *cache, const srp_cache_entry *entry) {
    const char *directory = srp_cache_directory(cache);
    size_t size = strlen(directory) + sizeof entry->name + 2;
    char *path = malloc(size);
    srp_table *table = NULL;
    srp_error error;
    if (entry->is_damaged || path == NULL) {
        printf("%s", entry->is_damaged ? "set aside" : "no memory to look");
        free(path);
        return;
    }
    snprintf(path, size, "%s/%s", directory, entry->name);
    if (srp_table_read(&srp_table_format_netcdf, path, &table, &error) != SRP_OK) {
        printf("cannot be read: %s", error.message);
    } else {
        const srp_table_info *info = srp_table_get_info(table);
        printf("%s (%s), %zu of %zu nodes", info->method, info->device,
               srp_table_filled_count(table), srp_grid_node_count(srp_table_grid(table)));
        srp_table_destroy(table);
    }
    free(path);
}

static int list(const srp_cache *cache) {
    srp_cache_entry *entries = NULL;
    size_t count = 0;
    uint64_t total = 0;
    srp_error error;
    if (srp_cache_list(cache, &entries, &count, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    for (size_t k = 0; k < count; ++k) {
        const time_t used = (time_t)entries[k].used;
        const struct tm *when = gmtime(&used);
        char date[24] = "?";
        if (when != NULL) {
            strftime(date, sizeof date, "%Y-%m-%d %H:%M", when);
        }
        printf("%s  %10llu bytes  used %s UTC  ", entries[k].name,
               (unsigned long long)entries[k].size, date);
        describe(cache, &entries[k]);
        putchar('\n');
        total += entries[k].size;
    }
    printf("%zu files, %llu bytes in %s\n", count, (unsigned long long)total,
           srp_cache_directory(cache));
    srp_cache_entries_free(entries);
    return CLI_DONE;
}

static int clear(srp_cache *cache) {
    size_t removed;
    srp_error error;
    if (srp_cache_clear(cache, &removed, &error) != SRP_OK) {
        return cli_output_error(&error);
    }
    printf("%zu files removed from %s\n", removed, srp_cache_directory(cache));
    return CLI_DONE;
}

static int path(const srp_cache *cache) {
    printf("%s\n", srp_cache_directory(cache));
    return CLI_DONE;
}

static int act(const cache_options *options, const cli_operands *operands) {
    if (operands->count != 1) {
        return cli_usage_error("expected one of list, clear and path, found %zu words",
                               operands->count);
    }
    const char *word = operands->items[0];
    bool lists = strcmp(word, "list") == 0, clears = strcmp(word, "clear") == 0;
    if (!lists && !clears && strcmp(word, "path") != 0) {
        return cli_usage_error("'%s': expected list, clear or path", word);
    }
    srp_cache_params params = srp_cache_params_default();
    srp_log log = cli_log();
    srp_cache *cache = NULL;
    srp_error error;
    params.directory = options->directory;
    if (srp_cache_open(&params, &log, &cache, &error) != SRP_OK) {
        return cli_input_error(&error);
    }
    int status = lists ? list(cache) : clears ? clear(cache) : path(cache);
    srp_cache_close(cache);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    cache_options options = {.directory = NULL};
    void *const targets[] = {&options};
    cli_operands operands;
    int status;
    if (cli_command_parse(command, argc, argv, targets, &operands, &status)) {
        status = act(&options, &operands);
    }
    return status;
}

const cli_command cli_command_cache = {
    .name = "cache",
    .operands = "list|clear|path",
    .operand_files = "",
    .operand_words = "list clear path",
    .summary = "directory of remembered tables",
    .description =
        "Tables that fill themselves, and runs of srp table with --cache, keep the nodes that they "
        "compute in a directory: srpcore in $XDG_CACHE_HOME, or in ~/.cache where that is not "
        "set.\n\n"
        "list shows its files, the last used first; clear removes them, and nothing else; path "
        "prints the name of the directory. Clearing costs time, never results. A file that was "
        "damaged is kept with .damaged behind its name until the cache is cleared or grows beyond "
        "its limit of 1 GiB.",
    .examples = "srp cache list\n"
                "srp cache clear\n"
                "srp cache path",
    .groups = GROUPS,
    .group_count = sizeof GROUPS / sizeof GROUPS[0],
    .run = run,
};
