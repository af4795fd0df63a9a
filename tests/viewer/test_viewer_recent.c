/* SPDX-License-Identifier: Apache-2.0 */
/* The list of recent files: what stands where, what it is called, what is remembered. */
#include "recent.h"
#include "srp_check.h"

static viewer v;

static void set_up(void) {
    v.application = g_object_new(G_TYPE_OBJECT, NULL); /* a place for the list */
}

static void tear_down(void) {
    g_object_unref(v.application);
}

static int length(void) {
    return g_menu_model_get_n_items(viewer_recent_menu(&v));
}

static void assert_text(int at, const char *attribute, const char *wanted) {
    char *text = NULL;
    g_menu_model_get_item_attribute(viewer_recent_menu(&v), at, attribute, "s", &text);
    ck_assert_str_eq(text, wanted);
    g_free(text);
}

static void assert_path(int at, const char *wanted) {
    assert_text(at, G_MENU_ATTRIBUTE_TARGET, wanted);
}

static void assert_label(int at, const char *wanted) {
    assert_text(at, G_MENU_ATTRIBUTE_LABEL, wanted);
}

static void note_numbered(int begin, int end) {
    for (int k = begin; k < end; ++k) {
        char path[32];
        snprintf(path, sizeof path, "/m/%d.obj", k);
        viewer_recent_note(&v, path);
    }
}

START_TEST(the_last_one_is_first) {
    note_numbered(0, 3);
    ck_assert_int_eq(length(), 3);
    assert_path(0, "/m/2.obj");
    viewer_recent_note(&v, "/m/0.obj");
    ck_assert_int_eq(length(), 3);
    assert_path(0, "/m/0.obj");
    assert_path(2, "/m/1.obj");
    viewer_recent_note(&v, "/m/\xff.obj"); /* no menu can name it */
    ck_assert_int_eq(length(), 3);
}
END_TEST

START_TEST(a_full_list_loses_the_oldest_alone) {
    note_numbered(0, 9);
    ck_assert_int_eq(length(), 8);
    assert_path(7, "/m/1.obj");
    viewer_recent_note(&v, "/m/4.obj");
    ck_assert_int_eq(length(), 8);
    assert_path(0, "/m/4.obj");
    assert_path(7, "/m/1.obj");
}
END_TEST

START_TEST(names_tell_files_apart) {
    char wide[300];
    viewer_recent_note(&v, "/home/a/old/model.obj");
    viewer_recent_note(&v, "/home/a/my_box.obj");
    assert_label(0, "my__box.obj");
    assert_label(1, "model.obj");
    viewer_recent_note(&v, "/home/a/new/model.obj");
    assert_label(0, "new/model.obj");
    assert_label(2, "old/model.obj");
    viewer_recent_note(&v, "/home/b/new/model.obj");
    assert_label(0, "b/new/model.obj");
    assert_label(1, "a/new/model.obj");
    assert_label(3, "old/model.obj");
    viewer_recent_note(&v, "model.obj");
    assert_label(0, "model.obj");
    snprintf(wide, sizeof wide, "/m/%s%0200dende.obj", "ä", 0);
    viewer_recent_note(&v, wide);
    char label[200];
    snprintf(label, sizeof label, "ä%031d…%024dende.obj", 0, 0);
    assert_label(0, label);
}
END_TEST

START_TEST(another_window_loses_nothing) {
    GKeyFile *file = g_key_file_new();
    const char *const theirs[] = {"/a", "/b", "/c", "/d", "/e", "/f", "/g", "/h"};
    viewer_recent_save(&v, file); /* nothing yet */
    g_key_file_set_string_list(file, "recent", "files", theirs, 7);
    viewer_recent_load(&v, file);
    ck_assert_int_eq(length(), 7);
    viewer_recent_note(&v, "/c");
    viewer_recent_note(&v, "/new");
    g_key_file_set_string_list(file, "recent", "files", &theirs[1], 7);
    viewer_recent_save(&v, file);
    gsize count;
    char **kept = g_key_file_get_string_list(file, "recent", "files", &count, NULL);
    char *joined = g_strjoinv(" ", kept);
    ck_assert_str_eq(joined, "/new /c /b /d /e /f /g /h");
    g_free(joined);
    g_strfreev(kept);
    g_key_file_unref(file);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("viewer recent");
    TCase *cases = tcase_create("recent");
    tcase_add_checked_fixture(cases, set_up, tear_down);
    tcase_add_test(cases, the_last_one_is_first);
    tcase_add_test(cases, a_full_list_loses_the_oldest_alone);
    tcase_add_test(cases, names_tell_files_apart);
    tcase_add_test(cases, another_window_loses_nothing);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
