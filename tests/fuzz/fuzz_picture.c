/* Fuzz target of the reader of scenes in pictures. */
#include "app/scene/scene.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    PictureText text;
    Error error = {""};
    const bool read = picture_text_parse("fuzz.png", (const char *)data, size, &text, &error);
    if (!read && (!*error.message || text.scene))
        abort(); /* refused without a word, or with something to free */
    if (read &&
        (text.size > PICTURE_TEXT_MAX || text.scene[text.size] != 0 || strlen(text.name) >= sizeof text.name))
        abort();
    free(text.scene);
    return 0;
}
