/* Checks of a text before parsing. */
#include "app/yaml/yaml.h"

/* A UTF-8 character. */
typedef struct Character {
    unsigned code;
    size_t length; /* 0: not allowed in YAML: a control character, or not UTF-8 */
} Character;

static Character character_at(const unsigned char *at, size_t left)
{
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (*at < 0x80) {
        const bool taken = (*at >= 0x20 && *at != 0x7f) || *at == '\t' || *at == '\n' || *at == '\r';
        return (Character){*at, taken};
    }
    const size_t length = *at >= 0xf8 ? 0 : *at >= 0xf0 ? 4 : *at >= 0xe0 ? 3 : *at >= 0xc0 ? 2 : 0;
    if (length == 0 || length > left)
        return (Character){0, 0};
    unsigned code = *at & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((at[i] & 0xc0) != 0x80)
            return (Character){0, 0};
        code = code << 6 | (at[i] & 0x3f);
    }
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return (Character){code, code >= least[length] && code < 0x110000 && !surrogate ? length : 0};
}

/* True if a line, and so a directive, may begin after the character: YAML's line breaks and the byte order
   mark. */
static bool begins_line(unsigned code)
{
    return code == '\n' || code == '\r' || code == 0x85 || code == 0x2028 || code == 0x2029 || code == 0xfeff;
}

bool yaml_text_check(const Tree *tree, const char *said, const char *bytes, size_t size, Error *error)
{
    Node place = {.line = 1, .column = 1, .said = said};
    unsigned before = '\n';
    for (size_t i = 0; i < size;) {
        const Character character = character_at((const unsigned char *)bytes + i, size - i);
        if (character.length == 0)
            return tree_error(tree, &place, error, "byte 0x%02x is no text; write YAML in UTF-8",
                              (unsigned char)bytes[i]);
        /* libfyaml 0.7 hangs on a directive at the end of the text. */
        if (character.code == '%' && begins_line(before))
            return tree_error(tree, &place, error,
                              "a directive (%%NAME), which means nothing here; leave the line out");
        place.column++;
        if (character.code == '\n') {
            place.line++;
            place.column = 1;
        }
        before = character.code;
        i += character.length;
    }
    return true;
}
