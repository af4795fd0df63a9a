/* SPDX-License-Identifier: Apache-2.0 */
#include "actions.h"

#include "dropping.h"
#include "exchange.h"
#include "facing.h"
#include "fit.h"
#include "loading.h"
#include "methods.h"
#include "numbers.h"
#include "opening.h"
#include "orbit.h"
#include "reoptic.h"
#include "saving.h"
#include "screenshot.h"
#include "ui.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- spacecraft ---- */

static void open_model(viewer *v, GVariant *parameter) {
    viewer_loading_open(v, g_variant_get_string(parameter, NULL));
}

static void choose_model(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_exchange_ask_open(v);
}

static void reload(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_request_engine(v, true);
}

/* After something was said of the setup: `good` or not, with the words about it. */
static void setup_said(viewer *v, bool good, const viewer_words *problem) {
    viewer_complain(v, good ? "" : problem->text);
    viewer_tell(v, CHANGED_SETUP);
    if (good) {
        viewer_request_engine(v, false);
    }
}

/* Files as a shell reads them. */
static void drop(viewer *v, GVariant *parameter) {
    char **paths = NULL;
    int count = 0;
    GError *error = NULL;
    if (!g_shell_parse_argv(g_variant_get_string(parameter, NULL), &count, &paths, &error)) {
        viewer_complain(v, error->message);
        g_error_free(error);
        return;
    }
    viewer_drop(v, (const char *const *)paths, (size_t)count);
    g_strfreev(paths);
}

static void set_unit(viewer *v, GVariant *parameter) {
    viewer_words problem = {""};
    const char *text = g_variant_get_string(parameter, NULL);
    bool good = viewer_setup_set_model_option(v->session->setup, MODEL_UNIT,
                                              strcmp(text, "m") == 0 ? "" : text, &problem);
    setup_said(v, good, &problem);
}

static void set_plates(viewer *v, GVariant *parameter) {
    viewer_words problem = {""};
    const char *path = g_variant_get_string(parameter, NULL);
    bool good = (path[0] == '\0' || viewer_engine_takes_plates(path, &problem)) &&
                viewer_setup_set_model_option(v->session->setup, MODEL_PLATES, path, &problem);
    setup_said(v, good, &problem);
}

static void choose_plates(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_exchange_ask_plates(v);
}

static void set_mass(viewer *v, GVariant *parameter) {
    viewer_words problem = {""};
    bool good =
        viewer_setup_set_mass(v->session->setup, g_variant_get_string(parameter, NULL), &problem);
    viewer_complain(v, good ? "" : problem.text);
    viewer_tell(v, CHANGED_SETUP | CHANGED_FORCE);
}

/* "NAME=RHO_S,RHO_D[,one-sided]"; "" forgets all that was said. */
static void set_material(viewer *v, GVariant *parameter) {
    const char *text = g_variant_get_string(parameter, NULL);
    viewer_words problem = {""};
    bool good = true;
    if (text[0] == '\0') {
        viewer_setup_clear_materials(v->session->setup);
    } else {
        good = viewer_setup_set_material_text(v->session->setup, text, &problem);
    }
    setup_said(v, good, &problem);
}

static void open_mtl(viewer *v, GVariant *parameter) {
    viewer_exchange_open_mtl(v, g_variant_get_string(parameter, NULL));
}

static void choose_mtl(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_exchange_ask_mtl(v);
}

/* ---- method ---- */

/* The option of this name; -1: none. */
static int option_named(const char *name) {
    for (int i = 0; i < METHOD_OPTION_COUNT; ++i) {
        if (strcmp(cli_group_method.options[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

static void set_option(viewer *v, int option, const char *text) {
    viewer_words problem = {""};
    bool good = viewer_setup_set_method_option(v->session->setup, option, text, &problem);
    setup_said(v, good, &problem);
}

static void set_method(viewer *v, GVariant *parameter) {
    set_option(v, METHOD_NAME, g_variant_get_string(parameter, NULL));
}

static void set_device(viewer *v, GVariant *parameter) {
    const char *text = g_variant_get_string(parameter, NULL);
    set_option(v, METHOD_DEVICE, strcmp(text, "cpu") == 0 ? "" : text);
}

/* "grid=1024"; "grid=" is the default. */
static void set_parameter(viewer *v, GVariant *parameter) {
    const char *text = g_variant_get_string(parameter, NULL);
    const char *equals = strchr(text, '=');
    char name[32] = "";
    if (equals != NULL && (size_t)(equals - text) < sizeof name) {
        memcpy(name, text, (size_t)(equals - text));
        name[equals - text] = '\0';
    }
    int option = option_named(name);
    if (option < 0 || equals == NULL) {
        viewer_complain(v, "expected NAME=VALUE with the name of an option of 'srp force'");
        return;
    }
    set_option(v, option, equals + 1);
}

/* ---- attitude ---- */

static void sun_moved(viewer *v) {
    viewer_request_force(v); /* first: it is computed while the panes show the Sun */
    viewer_tell(v, CHANGED_SUN);
}

static void turn(viewer *v, int axis, GVariant *parameter) {
    double degrees = g_variant_get_double(parameter);
    if (!(fabs(degrees) <= 180.0)) {
        char said[100];
        snprintf(said, sizeof said, "Rotation about %c %g: expected degrees from -180 to 180",
                 "XYZ"[axis], degrees);
        viewer_complain(v, said);
    } else if (v->session->attitude.turn_deg[axis] != degrees) {
        v->session->attitude.turn_deg[axis] = degrees;
        sun_moved(v);
    }
}

static void turn_x(viewer *v, GVariant *parameter) {
    turn(v, 0, parameter);
}

static void turn_y(viewer *v, GVariant *parameter) {
    turn(v, 1, parameter);
}

static void turn_z(viewer *v, GVariant *parameter) {
    turn(v, 2, parameter);
}

/* "AZ,EL" in degrees. */
static void set_sun(viewer *v, GVariant *parameter) {
    double at[2];
    const char *text = g_variant_get_string(parameter, NULL);
    if (!cli_read_numbers(text, 2, at) || fabs(at[0]) > 360.0 || fabs(at[1]) > 90.0) {
        char *line = g_strdup_printf(
            "Sun %s: expected AZ,EL: degrees from -360 to 360 and from -90 to 90", text);
        viewer_complain(v, line);
        g_free(line);
        return;
    }
    viewer_complain(v, "");
    v->session->attitude = viewer_attitude_for_sun(at[0], at[1]);
    sun_moved(v);
}

static void reset_attitude(viewer *v, GVariant *parameter) {
    (void)parameter;
    v->session->attitude = (viewer_attitude){{0.0, 0.0, 0.0}};
    sun_moved(v);
}

static void toggle_record(viewer *v, GVariant *parameter) {
    (void)parameter;
    if (!viewer_session_record(v->session, !v->session->recording)) {
        viewer_complain(v, "no memory for the arrow");
    }
    viewer_tell(v, CHANGED_ARROWS);
}

static void clear_arrows(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_session_clear_arrows(v->session);
    viewer_tell(v, CHANGED_ARROWS);
}

/* ---- looks ---- */

static void set_colouring(viewer *v, GVariant *parameter) {
    static const char *const names[] = {[SRP_RENDER_MATERIAL] = "material",
                                        [SRP_RENDER_INCIDENCE] = "incidence",
                                        [SRP_RENDER_FORCE] = "force"};
    const char *text = g_variant_get_string(parameter, NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(names); ++i) {
        if (strcmp(text, names[i]) == 0) {
            v->colouring = (srp_render_colouring)i;
            viewer_tell(v, CHANGED_VIEW);
            return;
        }
    }
    viewer_complain(v, "expected the colouring material, incidence or force");
}

/* "AZ,EL[,ZOOM]" */
static void set_camera(viewer *v, GVariant *parameter) {
    const char *text = g_variant_get_string(parameter, NULL);
    double at[3];
    if (!cli_read_numbers(text, 3, at) &&
        !(at[2] = v->camera.zoom, cli_read_numbers(text, 2, at))) {
        viewer_complain(v, "expected AZ,EL or AZ,EL,ZOOM");
        return;
    }
    viewer_set_camera(v, at[0], at[1], at[2]);
}

static void zoom_in(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_set_camera(v, v->camera.az_deg, v->camera.el_deg, 1.25 * v->camera.zoom);
}

static void zoom_out(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_set_camera(v, v->camera.az_deg, v->camera.el_deg, v->camera.zoom / 1.25);
}

static void reset_view(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_set_camera(v, -50.0, 24.0, 1.0);
}

static void toggle_shadows(viewer *v, GVariant *parameter) {
    (void)parameter;
    v->shadows = !v->shadows;
    viewer_tell(v, CHANGED_VIEW);
}

static void toggle_dark(viewer *v, GVariant *parameter) {
    (void)parameter;
    GtkSettings *settings = gtk_widget_get_settings(GTK_WIDGET(v->window));
    gboolean dark;
    g_object_get(settings, "gtk-application-prefer-dark-theme", &dark, NULL);
    g_object_set(settings, "gtk-application-prefer-dark-theme", !dark, NULL);
    viewer_tell(v, CHANGED_VIEW);
}

static void show_tab(viewer *v, GVariant *parameter) {
    const char *name = g_variant_get_string(parameter, NULL);
    for (int i = 0; i < TAB_COUNT; ++i) {
        if (strcmp(name, VIEWER_TAB_NAME[i]) == 0 && i < gtk_notebook_get_n_pages(v->tabs)) {
            gtk_notebook_set_current_page(v->tabs, i);
            return;
        }
    }
    viewer_complain(v, "expected the tab spacecraft, graphics, compare or orbit");
}

/* ---- tables ---- */

static void set_step(viewer *v, double *step, GVariant *parameter) {
    double degrees = g_variant_get_double(parameter);
    if (!(degrees >= VIEWER_STEP_MIN_DEG && degrees <= VIEWER_STEP_MAX_DEG)) {
        char said[100];
        snprintf(said, sizeof said, "%g: expected a step from %g to %g degrees", degrees,
                 VIEWER_STEP_MIN_DEG, VIEWER_STEP_MAX_DEG);
        viewer_complain(v, said);
        return;
    }
    *step = degrees;
    viewer_complain(v, "");
    viewer_tell(v, CHANGED_SETUP);
}

static void set_az_step(viewer *v, GVariant *parameter) {
    set_step(v, &v->az_step_deg, parameter);
}

static void set_el_step(viewer *v, GVariant *parameter) {
    set_step(v, &v->el_step_deg, parameter);
}

static void compute_table(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_request_table(v);
}

static void cancel(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_cancel_table(v);
    viewer_fit_cancel(v);
    viewer_reoptic_cancel(v);
    viewer_opening_cancel(v);
    viewer_loading_cancel(v);
#ifdef SRP_CLI_HAS_ORBIT
    viewer_orbit_cancel(v);
#endif
}

/* Tables are counted from 1, as lists show them. */
static void choose_table(viewer *v, GVariant *parameter, int *choice) {
    int number = g_variant_get_int32(parameter);
    if (number < 1 || (size_t)number > v->session->table_count) {
        viewer_complain(v, "there is no table of this number");
        return;
    }
    *choice = number - 1;
    viewer_tell(v, CHANGED_TABLES);
}

static void show_table(viewer *v, GVariant *parameter) {
    choose_table(v, parameter, &v->table_shown);
}

static void reoptic(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_reoptic_request(v);
}

/* What is being made of them goes with them; a table that is computed does not. */
static void clear_tables(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_fit_cancel(v);
    viewer_reoptic_cancel(v);
    viewer_opening_cancel(v);
    v->table_shown = v->compared[0] = v->compared[1] = -1;
    viewer_session_clear_tables(v->session);
    viewer_tell(v, CHANGED_TABLES);
}

static void compare_a(viewer *v, GVariant *parameter) {
    choose_table(v, parameter, &v->compared[0]);
}

/* The number of plates. */
static void fit(viewer *v, GVariant *parameter) {
    const char *text = g_variant_get_string(parameter, NULL);
    uint64_t plates;
    if (!cli_read_count(text, CLI_NORMALS_MAX, &plates) || plates < 1) {
        char *said = g_strdup_printf("Plates to fit %s: expected a whole number from 1 to %d", text,
                                     CLI_NORMALS_MAX);
        viewer_complain(v, said);
        g_free(said);
        return;
    }
    v->plates_to_fit = (int)plates;
    viewer_tell(v, CHANGED_SETUP);
    viewer_fit_request(v, (unsigned)v->plates_to_fit);
}

static void compare_b(viewer *v, GVariant *parameter) {
    choose_table(v, parameter, &v->compared[1]);
}

static void open_table(viewer *v, GVariant *parameter) {
    viewer_opening_add(v, g_variant_get_string(parameter, NULL));
}

static void choose_table_file(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_exchange_ask_table(v);
}

static void save(viewer *v, GVariant *parameter) {
    viewer_save(v, g_variant_get_string(parameter, NULL));
}

static void choose_save(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_exchange_ask_save(v);
}

static void toggle_together(viewer *v, GVariant *parameter) {
    (void)parameter;
    v->charts_together = !v->charts_together;
    viewer_tell(v, CHANGED_VIEW);
}

/* "N AZ,EL" */
static void set_chart_view(viewer *v, GVariant *parameter) {
    const char *text = g_variant_get_string(parameter, NULL);
    char *rest;
    double at[2];
    long number = strtol(text, &rest, 10);
    if (number < 1 || number > VIEWER_CHARTS || *rest != ' ' ||
        !cli_read_numbers(rest + 1, 2, at)) {
        viewer_complain(v, "expected N AZ,EL: a surface from 1 to 4, and degrees");
        return;
    }
    viewer_set_chart_view(v, (int)number - 1, at[0], at[1]);
}

#ifdef SRP_CLI_HAS_ORBIT
/* ---- orbits ---- */

static void open_mission(viewer *v, GVariant *parameter) {
    viewer_orbit_open(v, 0, g_variant_get_string(parameter, NULL));
}

static void open_versus(viewer *v, GVariant *parameter) {
    viewer_orbit_open(v, 1, g_variant_get_string(parameter, NULL));
}

static void choose_mission(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_exchange_ask_mission(v, 0);
}

static void choose_versus(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_exchange_ask_mission(v, 1);
}

static void propagate(viewer *v, GVariant *parameter) {
    (void)parameter;
    viewer_orbit_run(v);
}
#endif

/* ---- the program ---- */

static void copy_command(viewer *v, GVariant *parameter) {
    (void)parameter;
    char *line = viewer_check_engine(v) ? viewer_exchange_force_command(v) : NULL;
    if (line != NULL) {
        gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(v->window)), line);
        viewer_say(v, line);
        free(line);
    }
}

static void take_screenshot(viewer *v, GVariant *parameter) {
    viewer_screenshot(v, g_variant_get_string(parameter, NULL));
}

static void about(viewer *v, GVariant *parameter) {
    (void)parameter;
    gtk_show_about_dialog(v->window, "program-name", "srp-viewer", "version", SRP_VERSION,
                          "comments", "Solar radiation pressure on spacecraft, to be looked at",
                          "license-type", GTK_LICENSE_APACHE_2_0, "logo-icon-name", "srp-viewer",
                          NULL);
}

static void close_window(viewer *v, GVariant *parameter) {
    (void)parameter;
    gtk_window_close(v->window);
}

static const viewer_action ACTIONS[] = {
    {"open", "s", NULL, "Open an OBJ file.", open_model, DOES},
    {"choose-model", NULL, "<Control>o", "Ask for an OBJ file.", choose_model, LOOKS},
    {"drop", "s", NULL, "Take files by their endings, as those that are dropped on the window.",
     drop, DOES},
    {"reload", NULL, "<Control>r F5", "Read the files again.", reload, DOES},
    {"unit", "s", NULL, "Unit of the OBJ file: m, cm, mm, in, ft or a number of metres.", set_unit,
     DOES},
    {"plates", "s", NULL, "Plates file of the method nplate.", set_plates, DOES},
    {"choose-plates", NULL, NULL, "Ask for a plates file.", choose_plates, LOOKS},
    {"mass", "s", NULL, "Mass in kg; empty: not given.", set_mass, DOES},
    {"mtl", "s", NULL, "Take the optics of the materials from an MTL file.", open_mtl, DOES},
    {"choose-mtl", NULL, NULL, "Ask for an MTL file.", choose_mtl, LOOKS},
    {"material", "s", NULL, "NAME=RHO_S,RHO_D[,one-sided]; empty: as the files say.", set_material,
     DOES},
    {"method", "s", NULL, "Name of the method.", set_method, DOES},
    {"device", "s", NULL, "cpu, gl:osmesa, gl:egl.", set_device, DOES},
    {"parameter", "s", NULL, "NAME=VALUE, an option of 'srp force'.", set_parameter, DOES},
    {"turn-x", "d", NULL, "Rotation about X in degrees, from -180 to 180.", turn_x, LOOKS},
    {"turn-y", "d", NULL, "Rotation about Y in degrees, from -180 to 180.", turn_y, LOOKS},
    {"turn-z", "d", NULL, "Rotation about Z in degrees, from -180 to 180.", turn_z, LOOKS},
    {"sun", "s", NULL, "AZ,EL of the Sun in body axes, degrees.", set_sun, LOOKS},
    {"reset-attitude", NULL, "<Control>0", "All rotations to 0.", reset_attitude, LOOKS},
    {"record", NULL, "<Control>b", "Start or stop recording arrows.", toggle_record, LOOKS},
    {"clear-arrows", NULL, "<Control>Delete", "Forget all arrows.", clear_arrows, LOOKS},
    {"colouring", "s", NULL, "Colours of facets: material, incidence or force.", set_colouring,
     LOOKS},
    {"camera", "s", NULL, "AZ,EL[,ZOOM] of the eye; the Sun stands at 0,0.", set_camera, LOOKS},
    {"zoom-in", NULL, "<Control>plus <Control>equal", "Nearer.", zoom_in, LOOKS},
    {"zoom-out", NULL, "<Control>minus", "Farther.", zoom_out, LOOKS},
    {"reset-view", NULL, "<Control>Home", "The camera as at the start.", reset_view, LOOKS},
    {"shadows", NULL, NULL, "Shadows on or off.", toggle_shadows, LOOKS},
    {"dark", NULL, "<Control>d", "Dark style on or off.", toggle_dark, LOOKS},
    {"tab", "s", NULL, "Show spacecraft, graphics, compare or orbit.", show_tab, LOOKS},
    {"az-step", "d", NULL, "Step of azimuth for tables, degrees.", set_az_step, DOES},
    {"el-step", "d", NULL, "Step of elevation for tables, degrees.", set_el_step, DOES},
    {"compute-table", NULL, "<Control>t", "Compute a table.", compute_table, DOES},
    {"cancel", NULL, "<Control>period", "Stop what is computed.", cancel, DOES},
    {"show-table", "i", NULL, "Show the table of this number.", show_table, DOES},
    {"reoptic", NULL, NULL, "Make one of the optics of now from the table shown.", reoptic, DOES},
    {"clear-tables", NULL, NULL, "Forget all tables.", clear_tables, DOES},
    {"open-table", "s", NULL, "Open a table from disk.", open_table, DOES},
    {"choose-table", NULL, "<Control><Shift>o", "Ask for a table.", choose_table_file, LOOKS},
    {"save", "s", NULL,
     "Save what the tab shows: a picture (.png), table (.nc, .spo, .txt) or figure (.png, .svg, "
     ".pdf), comparison (.txt), fitted plates (.plates) or orbit (.csv).",
     save, DOES},
    {"choose-save", NULL, "<Control>s", "Ask where to save.", choose_save, LOOKS},
    {"turn-together", NULL, NULL, "Turn the four surfaces together or apart.", toggle_together,
     LOOKS},
    {"chart-view", "s", NULL, "N AZ,EL of the eye of surface 1 to 4, or of all that turn together.",
     set_chart_view, LOOKS},
    {"compare-a", "i", NULL, "The table that is compared with.", compare_a, DOES},
    {"compare-b", "i", NULL, "The table that is compared.", compare_b, DOES},
    {"fit", "s", NULL, "Fit so many plates (1 to 64) to table A; what they give becomes B.", fit,
     DOES},
#ifdef SRP_CLI_HAS_ORBIT
    {"mission", "s", NULL, "Open a mission file.", open_mission, DOES},
    {"choose-mission", NULL, NULL, "Ask for a mission file.", choose_mission, LOOKS},
    {"versus", "s", NULL, "Open the mission to compare with; empty: none.", open_versus, DOES},
    {"choose-versus", NULL, NULL, "Ask for the mission to compare with.", choose_versus, LOOKS},
    {"propagate", NULL, NULL, "Run the missions.", propagate, DOES},
#endif
    {"copy-command", NULL, "<Control><Shift>c", "Copy the command line that does the same.",
     copy_command, DOES},
    {"screenshot", "s", NULL, "Save a picture of the window as PNG.", take_screenshot, LOOKS},
    {"about", NULL, NULL, "About this program.", about, LOOKS},
    {"close", NULL, "<Control>q <Control>w", "Close the window.", close_window, DOES},
};

const viewer_action *viewer_action_list(size_t *count) {
    *count = G_N_ELEMENTS(ACTIONS);
    return ACTIONS;
}

static void on_activate(GSimpleAction *action, GVariant *parameter, gpointer user) {
    const viewer_action *which = g_object_get_data(G_OBJECT(action), "which");
    ui_take_typed(user); /* a key leaves no entry */
    if (which->kind == DOES) {
        viewer_forget_news(user);
    }
    which->run(user, parameter);
}

void viewer_actions_add(viewer *v) {
    for (size_t i = 0; i < G_N_ELEMENTS(ACTIONS); ++i) {
        const viewer_action *which = &ACTIONS[i];
        GVariantType *type = which->type != NULL ? g_variant_type_new(which->type) : NULL;
        GSimpleAction *action = g_simple_action_new(which->name, type);
        g_object_set_data(G_OBJECT(action), "which", (gpointer)(uintptr_t)which);
        g_signal_connect(action, "activate", G_CALLBACK(on_activate), v);
        g_action_map_add_action(G_ACTION_MAP(v->window), G_ACTION(action));
        if (which->keys != NULL) {
            char **keys = g_strsplit(which->keys, " ", -1);
            char *full = g_strconcat("win.", which->name, NULL);
            gtk_application_set_accels_for_action(v->application, full, (const char *const *)keys);
            g_free(full);
            g_strfreev(keys);
        }
        g_object_unref(action);
        if (type != NULL) {
            g_variant_type_free(type);
        }
    }
}
