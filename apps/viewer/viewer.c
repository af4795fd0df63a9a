/* SPDX-License-Identifier: Apache-2.0 */
#include "viewer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *const VIEWER_TAB_NAME[TAB_COUNT] = {"spacecraft", "graphics", "compare", "orbit"};

typedef struct listening {
    viewer_listener changed;
    void *pane;
} listening;

void viewer_listen(viewer *v, viewer_listener changed, void *pane) {
    listening *entry = g_new0(listening, 1);
    *entry = (listening){changed, pane};
    g_ptr_array_add(v->listeners, entry);
}

void viewer_tell(viewer *v, unsigned what) {
    for (guint i = 0; v->window != NULL && i < v->listeners->len; ++i) {
        const listening *entry = g_ptr_array_index(v->listeners, i);
        entry->changed(entry->pane, what);
    }
}

/* What is wrong comes first, news under it. */
static void show_message(viewer *v) {
    const char *between = v->problem[0] != '\0' && v->news[0] != '\0' ? "\n" : "";
    snprintf(v->message, sizeof v->message, "%s%s%s", v->problem, between, v->news);
    viewer_tell(v, CHANGED_MESSAGE);
}

void viewer_say(viewer *v, const char *text) {
    g_strlcpy(v->news, text, sizeof v->news);
    show_message(v);
}

void viewer_say_too(viewer *v, const char *text) {
    if (strstr(v->news, text) == NULL) {
        g_strlcat(v->news, v->news[0] != '\0' ? "\n" : "", sizeof v->news);
        g_strlcat(v->news, text, sizeof v->news);
        show_message(v);
    }
}

void viewer_forget_news(viewer *v) {
    if (v->news[0] != '\0') {
        viewer_say(v, "");
    }
}

void viewer_dismiss(viewer *v) {
    v->problem[0] = '\0';
    viewer_say(v, "");
}

/* The same complaint twice is told twice: it is of two things that went wrong. */
void viewer_complain_about(viewer *v, viewer_topic topic, const char *text) {
    char words[VIEWER_WORDS_SIZE];
    viewer_words_for_window(text, words, sizeof words);
    if (words[0] != '\0') {
        v->topic = topic;
        ++v->complaints;
        v->news[0] = '\0';
    } else if (v->problem[0] == '\0' || v->topic != topic) {
        return;
    }
    g_strlcpy(v->problem, words, sizeof v->problem);
    show_message(v);
}

void viewer_complain(viewer *v, const char *text) {
    viewer_complain_about(v, ABOUT_STEP, text);
}

void viewer_complain_of_model(viewer *v, const char *text) {
    viewer_complain_about(v, ABOUT_MODEL, text);
}

void viewer_set_camera(viewer *v, double az_deg, double el_deg, double zoom) {
    v->camera =
        (viewer_camera){az_deg, fmax(-90.0, fmin(90.0, el_deg)), fmax(0.05, fmin(50.0, zoom))};
    viewer_tell(v, CHANGED_VIEW);
}

void viewer_set_chart_view(viewer *v, int chart, double az_deg, double el_deg) {
    double az = fmod(az_deg, 360.0);
    for (int k = 0; k < VIEWER_CHARTS; ++k) {
        if (k == chart || v->charts_together) {
            v->chart_view[k][0] = az < 0.0 ? az + 360.0 : az;
            v->chart_view[k][1] = fmax(0.0, fmin(90.0, el_deg));
        }
    }
    viewer_tell(v, CHANGED_VIEW);
}

bool viewer_is_window_size(int width, int height) {
    return MIN(width, height) >= WINDOW_SIZE_MIN && MAX(width, height) <= WINDOW_SIZE_MAX;
}

void viewer_act(viewer *v, const char *action, GVariant *parameter) {
    g_action_group_activate_action(G_ACTION_GROUP(v->window), action, parameter);
}

void viewer_act_text(viewer *v, const char *action, const char *text) {
    char *valid = g_utf8_make_valid(text, -1);
    viewer_act(v, action, g_variant_new_string(valid));
    g_free(valid);
}
