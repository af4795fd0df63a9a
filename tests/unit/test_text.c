/* SPDX-License-Identifier: Apache-2.0 */
#include "error.h"
#include "srp_check.h"
#include "text.h"

#include <string.h>

static srp_text open_text(const char *bytes, unsigned flags) {
    srp_text text;
    srp_error error;
    assert_ok(srp_text_open(&text, bytes, strlen(bytes), "f", flags, &error), error);
    return text;
}

/* Asserts the next token: its characters and its place. */
static void expect_token(srp_text *text, const char *word, size_t line, size_t column) {
    srp_token token;
    ck_assert_msg(srp_text_next_token(text, &token), "expected '%s', found the line's end", word);
    ck_assert_msg(srp_token_is(token, word), "found '%.*s', expected '%s'", (int)token.size,
                  token.text, word);
    ck_assert_uint_eq(token.line, line);
    ck_assert_uint_eq(token.column, column);
}

static void expect_line_end(srp_text *text, size_t line, size_t column) {
    srp_token token;
    ck_assert(!srp_text_next_token(text, &token));
    ck_assert_uint_eq(token.size, 0);
    ck_assert_uint_eq(token.line, line);
    ck_assert_uint_eq(token.column, column);
}

START_TEST(tokens_know_their_place) {
    const char *ends[] = {"\n", "\r\n", "\r"};
    for (int i = 0; i < 3; i++) {
        char bytes[100];
        snprintf(bytes, sizeof bytes, "\xef\xbb\xbf%s ab\t c%s%s  \v\f%sx # y%s#z%slast", "",
                 ends[i], ends[i], ends[i], ends[i], ends[i]);
        srp_text text = open_text(bytes, SRP_TEXT_COMMENTS);
        ck_assert(srp_text_next_line(&text));
        expect_token(&text, "ab", 1, 2);
        expect_token(&text, "c", 1, 6);
        expect_line_end(&text, 1, 7);
        ck_assert(srp_text_next_line(&text));
        expect_token(&text, "x", 4, 1);
        expect_line_end(&text, 4, 3);
        ck_assert(srp_text_next_line(&text));
        expect_token(&text, "last", 6, 1);
        expect_line_end(&text, 6, 5);
        ck_assert(!srp_text_next_line(&text));
    }
}
END_TEST

START_TEST(unread_tokens_are_skipped) {
    srp_text text = open_text("a b \\\n c # d\ne", SRP_TEXT_COMMENTS | SRP_TEXT_CONTINUED_LINES);
    ck_assert(srp_text_next_line(&text));
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "e", 3, 1);
}
END_TEST

START_TEST(backslash_joins_lines) {
    unsigned both = SRP_TEXT_COMMENTS | SRP_TEXT_CONTINUED_LINES;
    srp_text text = open_text("a\\\r\n b \\ \n\\\nc:\\d\ne", both);
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "a", 1, 1);
    expect_token(&text, "b", 2, 2);
    expect_token(&text, "c:\\d", 4, 1);
    expect_line_end(&text, 4, 5);
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "e", 5, 1);

    /* A comment ends with its line: what follows must not vanish. */
    text = open_text("# a \\\nb", both);
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "b", 2, 1);

    text = open_text("a \\", both);
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "a", 1, 1);
    ck_assert(!srp_text_next_token(&text, &(srp_token){0}));
    ck_assert(!srp_text_next_line(&text));

    text = open_text("a \\\nb", 0);
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "a", 1, 1);
    expect_token(&text, "\\", 1, 3);
}
END_TEST

START_TEST(hash_inside_a_word_is_no_comment) {
    srp_text text = open_text("usemtl  Material #25 b \t# note\nx#1 #", SRP_TEXT_COMMENTS);
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "usemtl", 1, 1);
    srp_token rest = srp_text_rest(&text);
    ck_assert(srp_token_is(rest, "Material #25 b"));
    ck_assert_uint_eq(rest.column, 9);
    ck_assert(srp_text_next_line(&text));
    expect_token(&text, "x#1", 2, 1);
    ck_assert_uint_eq(srp_text_rest(&text).size, 0);
    ck_assert(!srp_text_next_line(&text));

    /* Without comments it is a byte like any other. */
    text = open_text("# a : b # c \n", 0);
    ck_assert(srp_text_next_line(&text));
    ck_assert(srp_token_is(srp_text_rest(&text), "# a : b # c"));
}
END_TEST

START_TEST(empty_texts_have_no_line) {
    const char *empty[] = {"", "\n", "\r\n\r\n", "  \t", "# x", "\xef\xbb\xbf", "\xef\xbb\xbf\n"};
    for (size_t i = 0; i < sizeof empty / sizeof *empty; i++) {
        srp_text text = open_text(empty[i], SRP_TEXT_COMMENTS);
        ck_assert(!srp_text_next_line(&text));
        ck_assert(!srp_text_next_line(&text));
    }
}
END_TEST

static srp_token word(const char *characters) {
    return (srp_token){.text = characters, .size = strlen(characters), .line = 3, .column = 5};
}

START_TEST(decimals_are_read_to_the_last_bit) {
    srp_text text = open_text("", 0);
    srp_error error;
    const char *good[] = {"0",
                          "-0.0",
                          "+1.5",
                          ".5",
                          "5.",
                          "1e5",
                          "-1.25E-10",
                          "1e-400",
                          "4.9e-324",
                          "007",
                          "1.7976931348623157e308",
                          "0.1000000000000000055511151231257827021181583404541015625"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        double value = NAN;
        assert_ok(srp_token_double(&text, word(good[i]), "x", &value, &error), error);
        double want = strtod(good[i], NULL);
        ck_assert_msg(memcmp(&value, &want, sizeof value) == 0, "%s", good[i]);
    }
}
END_TEST

START_TEST(other_numbers_are_refused) {
    srp_text text = open_text("", 0);
    srp_error error;
    const char *bad[] = {"nan", "inf",   "-INF", "0x10", "1e",  "1e+", ".",     "-",      "+",   "",
                         "1,5", "1.2.3", "1d5",  "--1",  "1 2", "e5",  "1e999", "-1e309", "\xff"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double value = 7.0;
        ck_assert_int_eq(srp_token_double(&text, word(bad[i]), "x", &value, &error),
                         SRP_BAD_FORMAT);
        ck_assert_msg(value == 7.0, "%s", bad[i]);
        ck_assert_uint_eq(error.line, 3);
        ck_assert_uint_eq(error.column, 5);
    }
    char longest[1000];
    memset(longest, '1', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    double value;
    ck_assert_int_eq(srp_token_double(&text, word(longest), "x", &value, &error), SRP_BAD_FORMAT);
}
END_TEST

START_TEST(integers_keep_to_their_range) {
    srp_text text = open_text("", 0);
    srp_error error;
    struct {
        const char *word;
        int64_t value;
        bool good;
    } cases[] = {
        {"0", 0, true},
        {"-10", -10, true},
        {"+10", 10, true},
        {"010", 10, true},
        {"11", 0, false},
        {"-11", 0, false},
        {"1.0", 0, false},
        {"", 0, false},
        {"-", 0, false},
        {"0x1", 0, false},
        {"9223372036854775807", 0, false},
        {"99999999999999999999999999999999", 0, false},
        {"-99999999999999999999999999999999", 0, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int64_t value = 77;
        srp_status status =
            srp_token_integer(&text, word(cases[i].word), "x", -10, 10, &value, &error);
        ck_assert_msg((status == SRP_OK) == cases[i].good, "%s", cases[i].word);
        ck_assert_int_eq(value, cases[i].good ? cases[i].value : 77);
    }
    int64_t value;
    assert_ok(srp_token_integer(&text, word("-9223372036854775808"), "x", INT64_MIN, INT64_MAX,
                                &value, &error),
              error);
    ck_assert(value == INT64_MIN);
}
END_TEST

START_TEST(complaints_name_the_place) {
    srp_text text = open_text("a\n  1.5 two\n", 0);
    srp_error error;
    char words[400];
    double value;
    ck_assert(srp_text_next_line(&text) && srp_text_next_line(&text));
    assert_ok(srp_text_double(&text, "the area", &value, NULL, &error), error);
    ck_assert_int_eq(srp_text_double(&text, "the mass", &value, NULL, &error), SRP_BAD_FORMAT);
    srp_error_format(&error, words, sizeof words);
    ck_assert_str_eq(words, "f:2:7: found 'two', expected a finite number: the mass");
    int64_t count;
    ck_assert_int_eq(srp_text_integer(&text, "a count", 0, 9, &count, NULL, &error),
                     SRP_BAD_FORMAT);
    srp_error_format(&error, words, sizeof words);
    ck_assert_str_eq(words, "f:2:10: found the end of the line, expected a whole number: a count");
    assert_ok(srp_text_end_of_line(&text, &error), error);

    text = open_text("a b", 0);
    ck_assert(srp_text_next_line(&text));
    ck_assert_int_eq(srp_text_end_of_line(&text, &error), SRP_BAD_FORMAT);
    srp_error_format(&error, words, sizeof words);
    ck_assert_str_eq(words, "f:1:1: found 'a', expected the end of the line");
}
END_TEST

START_TEST(excerpts_are_printable_and_bounded) {
    ck_assert_str_eq(srp_token_excerpt(word("a\x1b[31m\x7f\x01")).text, "'a\\x1b[31m\\x7f\\x01'");
    ck_assert_str_eq(srp_token_excerpt(word("fl\xc3\xa4"
                                            "che \xe2\x82\xac \xf0\x9f\x9b\xb0"))
                         .text,
                     "'fl\xc3\xa4"
                     "che \xe2\x82\xac \xf0\x9f\x9b\xb0'");
    /* Broken, overlong, surrogate, beyond U+10FFFF, C1 control. */
    ck_assert_str_eq(srp_token_excerpt(word("\xc3")).text, "'\\xc3'");
    ck_assert_str_eq(srp_token_excerpt(word("\xc0\x80")).text, "'\\xc0\\x80'");
    ck_assert_str_eq(srp_token_excerpt(word("\xe0\x80\x80")).text, "'\\xe0\\x80\\x80'");
    ck_assert_str_eq(srp_token_excerpt(word("\xed\xa0\x80")).text, "'\\xed\\xa0\\x80'");
    ck_assert_str_eq(srp_token_excerpt(word("\xf4\x90\x80\x80")).text, "'\\xf4\\x90\\x80\\x80'");
    ck_assert_str_eq(srp_token_excerpt(word("\xc2\x9b")).text, "'\\xc2\\x9b'");
    char worst[1000];
    memset(worst, 0x01, sizeof worst - 1);
    worst[sizeof worst - 1] = '\0';
    srp_excerpt excerpt = srp_token_excerpt(word(worst));
    ck_assert_uint_eq(strlen(excerpt.text), 48 * 4 + 5);
    ck_assert_str_eq(excerpt.text + strlen(excerpt.text) - 8, "\\x01...'");
    ck_assert_str_eq(srp_string_excerpt("").text, "''");
    ck_assert_str_eq(srp_string_excerpt("gold").text, "'gold'");
}
END_TEST

START_TEST(names_become_utf8) {
    static const struct {
        const char *bytes, *name;
    } names[] = {
        {"gold foil", "gold foil"},
        {"Folie \xc3\xa9\xe2\x82\xac\xf0\x9f\x9b\xb0\tb",
         "Folie \xc3\xa9\xe2\x82\xac\xf0\x9f\x9b\xb0\tb"},
        {"caf\xe9", "caf\\xe9"},
        {"\xe9\xe9t\xe9", "\\xe9\\xe9t\\xe9"},
        {"\xc0\x80 \xed\xa0\x80", "\\xc0\\x80 \\xed\\xa0\\x80"}, /* overlong, a surrogate */
        {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},            /* beyond Unicode */
        {"\xe2\x82", "\\xe2\\x82"},                              /* cut short */
    };
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        srp_token token = {.text = names[k].bytes, .size = strlen(names[k].bytes)};
        char *name = srp_token_name(token);
        ck_assert_str_eq(name, names[k].name);
        ck_assert_int_eq(srp_token_is_utf8(token), k < 2);
        free(name);
    }
}
END_TEST

START_TEST(what_is_no_text_is_refused) {
    srp_text text;
    srp_error error;
    ck_assert_int_eq(srp_text_open(&text, "ab\nc\0d", 6, "f", 0, &error), SRP_BAD_FORMAT);
    ck_assert_uint_eq(error.line, 2);
    ck_assert_uint_eq(error.column, 2);
    ck_assert_ptr_nonnull(strstr(error.message, "binary"));
    ck_assert_int_eq(srp_text_open(&text,
                                   "\xff\xfe"
                                   "v\0",
                                   4, "f", 0, &error),
                     SRP_BAD_FORMAT);
    ck_assert_ptr_nonnull(strstr(error.message, "UTF-16"));

    char *line = malloc((size_t)SRP_TEXT_LINE_MAX + 2);
    ck_assert_ptr_nonnull(line);
    memset(line, 'a', (size_t)SRP_TEXT_LINE_MAX + 2);
    line[0] = '\n';
    assert_ok(srp_text_open(&text, line, (size_t)SRP_TEXT_LINE_MAX + 1, "f", 0, &error), error);
    ck_assert_int_eq(srp_text_open(&text, line, (size_t)SRP_TEXT_LINE_MAX + 2, "f", 0, &error),
                     SRP_BAD_FORMAT);
    ck_assert_uint_eq(error.line, 2);
    free(line);
}
END_TEST

START_TEST(files_are_read_or_refused) {
    char *bytes;
    size_t size;
    srp_error error;
    ck_assert_int_eq(srp_text_read_file("no/such/file", &bytes, &size, &error), SRP_NOT_FOUND);
    ck_assert_str_eq(error.file, "no/such/file");
    ck_assert_int_eq(srp_text_read_file(".", &bytes, &size, &error), SRP_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "directory"));
    ck_assert_int_eq(srp_text_read_file("/dev/zero", &bytes, &size, &error), SRP_BAD_FORMAT);
    ck_assert_ptr_nonnull(strstr(error.message, "binary"));
}
END_TEST

int main(void) {
    Suite *suite = suite_create("text");
    TCase *tcase = tcase_create("text");
    tcase_add_test(tcase, tokens_know_their_place);
    tcase_add_test(tcase, unread_tokens_are_skipped);
    tcase_add_test(tcase, backslash_joins_lines);
    tcase_add_test(tcase, hash_inside_a_word_is_no_comment);
    tcase_add_test(tcase, empty_texts_have_no_line);
    tcase_add_test(tcase, decimals_are_read_to_the_last_bit);
    tcase_add_test(tcase, other_numbers_are_refused);
    tcase_add_test(tcase, integers_keep_to_their_range);
    tcase_add_test(tcase, complaints_name_the_place);
    tcase_add_test(tcase, excerpts_are_printable_and_bounded);
    tcase_add_test(tcase, names_become_utf8);
    tcase_add_test(tcase, what_is_no_text_is_refused);
    tcase_add_test(tcase, files_are_read_or_refused);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
