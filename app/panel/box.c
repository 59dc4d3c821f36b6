/* Box size: the requested size; walls move at limited speed. */
#include "app/panel/panel_parts.h"

#include <string.h>

void panel_box(Ui *ui, const PanelData *data, PanelEvents *events)
{
    const WorldDef *def = &data->scene->world;
    const double least = 6 * def->spacing;
    const UiField field = {
        "box.size", "size",
        "width, height and depth; walls come in slowly, so that the fluid keeps calm\nCtrl + click to type a number"};
    const UiScale scale = {
        .low = least, .high = 2 * data->box_most, .least = least, .most = 1000, .unit = "m"};
    double size[3];
    if (!ui_section(ui, "Box", false))
        return;
    memcpy(size, data->box_wanted, sizeof size);
    if (!ui_sliders(ui, &field, size, def->dimensions, &scale))
        return;
    memcpy(events->size, size, sizeof events->size);
    events->sized = true;
}
