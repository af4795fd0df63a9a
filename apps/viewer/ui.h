/* SPDX-License-Identifier: Apache-2.0 */
/* Widgets that panes are made of: every one has a name, by which scripts find it. */
#ifndef SRP_VIEWER_UI_H
#define SRP_VIEWER_UI_H

#include "viewer.h"

#include <gtk/gtk.h>

GtkWidget *ui_box(GtkOrientation orientation, int spacing);
/* Text; `classes`: style classes separated by blanks, may be NULL. */
GtkWidget *ui_label(const char *text, const char *classes);
/* Text that goes on in further lines, none of them less than `width` characters wide. */
GtkWidget *ui_paragraph(const char *name, const char *classes, int width);
/* A number that is shown: equal widths, can be selected and copied. Screen readers say `words`
 * before it. */
GtkWidget *ui_value(const char *name, const char *words);
/* "_Label" that moves the focus to `target`, and names it if nothing has. */
GtkWidget *ui_mnemonic(const char *text, GtkWidget *target);
/* A button "_Text" that activates the action "win.name". */
GtkWidget *ui_button(const char *text, const char *action, const char *tip);
/* A bar with words in it; `called`: what a screen reader calls it. */
GtkWidget *ui_progress(const char *name, const char *called);
/* The button says the name of a file as it is, or "_Words" while there is none. */
void ui_button_show_file(GtkWidget *button, const char *path, const char *words);
/* A check button "_Text". */
GtkWidget *ui_check(const char *text);
/* What a screen reader calls a widget, whatever words it shows. */
void ui_name(GtkWidget *widget, const char *words);
/* A button "_Text" that opens a popover or menu; set these and other texts as GTK does. */
GtkWidget *ui_menu_button(const char *text);
/* A box whose children go on in further lines where the window is too narrow for them. */
GtkWidget *ui_strip(int spacing);
/* The same behind a title, in bold; further lines begin where the first does behind it. */
GtkWidget *ui_titled_strip(GtkWidget *title);
/* A control behind its word, which stay together. */
GtkWidget *ui_pair(GtkWidget *word, GtkWidget *control);
/* A column beside a picture, which scrolls where the window is too low for it. */
GtkWidget *ui_side(GtkWidget *column);
/* What a button shows, which scrolls where it is higher than `height`. */
GtkWidget *ui_popover(GtkWidget *child, int height);
/* A small "i" that explains. */
GtkWidget *ui_explanation(const char *heading, const char *text);
/* An entry `width` characters wide that sends its text to `action` as "KEY=text" (key NULL: the
 * text alone) when it is activated or left. The action lets panes show what it has made of it: a
 * text that was refused gives way to the one before. */
GtkWidget *ui_entry(viewer *v, const char *name, int width, const char *action, const char *key);
/* Sets the text unless the user is typing in it. */
void ui_entry_show(GtkWidget *entry, const char *text);
/* What a number can be, and by how much its buttons change it. */
typedef struct ui_range {
    double least, most, step;
    bool whole;
} ui_range;
typedef void (*ui_number_changed)(GtkWidget *number, void *user);
/* A number with buttons; screen readers and complaints call it `words`. A text that is no number of
 * the range is complained of, and gives way to the number before; so does a number that `changed`
 * does not show. */
GtkWidget *ui_number(viewer *v, const char *name, const char *words, ui_range range,
                     ui_number_changed changed, void *user);
/* As the user gave it: what another number is rounded to in order to be shown is not lost. */
double ui_number_value(GtkWidget *number);
void ui_number_show(GtkWidget *number, double value);
/* What the user is typing, as if the entry or number were left. */
void ui_take_typed(viewer *v);
/* A drop-down of words, which are cut where there is no room for them. `chosen` has the signature
 * of notify signals. */
GtkWidget *ui_choice(const char *name, GCallback chosen, gpointer user);
/* What there is to choose from. The callback hears of it, too. */
void ui_choice_set(GtkDropDown *choice, const char *const *words, guint selected);
/* The tables of the session; `selected` -1: none. */
void ui_choice_set_tables(viewer *v, GtkDropDown *choice, int selected);
/* Removes all children of a box or grid. */
void ui_clear(GtkWidget *parent);
/* The widget of this name in the window, NULL: none. */
GtkWidget *ui_find(viewer *v, const char *name);
/* The names of all that are there now, with blanks between them; freed by g_free(). */
char *ui_names(viewer *v);

#endif
