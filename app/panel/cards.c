/* Overlay for choosing a scene. */
#include "app/panel/panel.h"

#include "app/input/play_commands.h"

#include <math.h>
#include <stdio.h>

static const float CARD_EM = 26, WIDTH_EM = 82, SHAPE = 16.0F / 9;

int panel_cards_draw(Ui *ui, int width, int height, const SceneCard *cards, int count)
{
    const float em = ui_pixels(ui);
    const UiWindow window = {.id = "scenes",
                             .place = {floorf(0.5F * (float)width), floorf(0.5F * (float)height)},
                             .pivot = {0.5F, 0.5F},
                             .width = fmaxf(fminf(floorf(WIDTH_EM * em), (float)width - 2 * em), 1),
                             .height_most = fmaxf((float)height - 2 * em, 1)};
    const float room = window.width - 3 * em;
    const float columns = fmaxf(floorf(room / (CARD_EM * em)), 1);
    char keys[80], text[160];
    int pressed = -1;
    ui_window_begin(ui, &window);
    play_command_keys_text(&play_command_rows[PLAY_SCENES], keys, sizeof keys);
    snprintf(text, sizeof text, "Scenes. A click opens one; %s closes this list.", keys);
    ui_text(ui, text);
    ui_gap(ui);
    for (int i = 0; i < count; i++) {
        const UiCard card = {.id = cards[i].path,
                             .title = cards[i].title,
                             .text = cards[i].text,
                             .texture = cards[i].texture,
                             .shape = SHAPE,
                             .width = floorf(room / columns - em)};
        if (ui_card(ui, &card, cards[i].lit))
            pressed = i;
    }
    ui_window_end(ui);
    return pressed;
}
