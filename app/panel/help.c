/* Overlay listing all user commands. */
#include "app/panel/panel.h"

#include "app/input/play_commands.h"

#include <math.h>
#include <stdio.h>

void panel_help_draw(Ui *ui, int width, int height)
{
    static const float WIDTH_EM = 44, KEYS_SHARE = 0.36F;
    const float em = ui_pixels(ui);
    const UiWindow window = {.id = "help",
                             .place = {floorf(0.5F * (float)width), floorf(0.5F * (float)height)},
                             .pivot = {0.5F, 0.5F},
                             .width = fmaxf(fminf(floorf(WIDTH_EM * em), (float)width - 2 * em), 1),
                             .height_most = fmaxf((float)height - 2 * em, 1),
                             .label_share = KEYS_SHARE};
    char keys[80], text[160];
    ui_window_begin(ui, &window);
    play_command_keys_text(&play_command_rows[PLAY_HELP], keys, sizeof keys);
    snprintf(text, sizeof text, "What you can do. %s closes this list.", keys);
    ui_text(ui, text);
    ui_gap(ui);
    for (const PlayCommandRow *row = play_command_rows; row->name; row++) {
        play_command_keys_text(row, keys, sizeof keys);
        if (row->group) {
            ui_gap(ui);
            ui_text(ui, row->group);
            ui_faint(ui, row->example);
        }
        ui_row(ui, keys, row->help);
    }
    ui_window_end(ui);
}
