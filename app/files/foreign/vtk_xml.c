/* The points of VTK's XML files .vtp and .vtu, and the index .pvd. After: "VTK XML file formats",
   https://docs.vtk.org. Arrays are text, base64 or appended, raw or compressed by zlib. */
#include "app/files/foreign/foreign.h"

#include <expat.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { ARRAYS_MAX = 1024 };

typedef enum ArrayForm { ARRAY_ASCII, ARRAY_BASE64, ARRAY_APPENDED } ArrayForm;

typedef struct XmlArray {
    char name[FOREIGN_NAME_SIZE], type[16];
    double tuples; /* of FieldData */
    int components;
    int piece; /* -1: of FieldData */
    ArrayForm form;
    size_t begin, end; /* in the file; of an appended array the offset */
} XmlArray;

typedef struct Xml {
    const ForeignBytes *file;
    XML_Parser parser;
    bool big, wide, zlib, known;
    bool raw;        /* appended data without base64 */
    size_t appended; /* begin of the appended data; 0: none */
    char section[24];
    int pieces;
    size_t count[ARRAYS_MAX]; /* points of each piece */
    int array_count;
    XmlArray array[ARRAYS_MAX];
    bool open;      /* in a DataArray, before its end or first child */
    bool head_only; /* stop at the first piece, unless the arrays before it are behind all */
    bool offsets;
    char unable[128];
    Error *error;
} Xml;

static const char *attribute(const char **attributes, const char *name)
{
    for (; *attributes; attributes += 2)
        if (strcmp(attributes[0], name) == 0)
            return attributes[1];
    return "";
}

static void copy(char *to, size_t size, const char *from)
{
    const size_t length = strlen(from) < size ? strlen(from) : size - 1;
    memcpy(to, from, length);
    to[length] = '\0';
}

static void stop(Xml *xml, const char *why)
{
    copy(xml->unable, sizeof xml->unable, why);
    XML_StopParser(xml->parser, XML_FALSE);
}

/* ---- the tags ---- */

static void begin_file(Xml *xml, const char **attributes)
{
    const char *type = attribute(attributes, "type"), *packed = attribute(attributes, "compressor");
    xml->known = strcmp(type, "PolyData") == 0 || strcmp(type, "UnstructuredGrid") == 0;
    xml->big = strcmp(attribute(attributes, "byte_order"), "BigEndian") == 0;
    xml->wide = strcmp(attribute(attributes, "header_type"), "UInt64") == 0;
    xml->zlib = strcmp(packed, "vtkZLibDataCompressor") == 0;
    if (*packed && !xml->zlib)
        stop(xml, "is compressed by another means than zlib; write it with vtkZLibDataCompressor or none");
    else if (!xml->known)
        stop(xml, "has no points of particles; the type of the VTKFile must be PolyData or UnstructuredGrid");
}

static void begin_piece(Xml *xml, const char **attributes)
{
    const double count = atof(attribute(attributes, "NumberOfPoints"));
    Error none;
    if (xml->pieces == ARRAYS_MAX)
        stop(xml, "has more than 1024 pieces");
    else if (!foreign_count_fits(xml->file, count, &none))
        stop(xml, "claims more points than its bytes can hold; it is damaged");
    else
        xml->count[xml->pieces++] = (size_t)count;
}

static void begin_array(Xml *xml, const char **attributes)
{
    const char *format = attribute(attributes, "format");
    const bool points = strcmp(xml->section, "Points") == 0, field = strcmp(xml->section, "FieldData") == 0;
    if (!points && !field && strcmp(xml->section, "PointData") != 0)
        return;
    if (xml->array_count == ARRAYS_MAX) {
        stop(xml, "has more than 1024 arrays");
        return;
    }
    XmlArray *array = &xml->array[xml->array_count];
    *array = (XmlArray){.piece = field ? -1 : xml->pieces - 1, .components = 1};
    if (!field && array->piece < 0)
        return;
    copy(array->name, sizeof array->name, points ? "Points" : attribute(attributes, "Name"));
    copy(array->type, sizeof array->type, attribute(attributes, "type"));
    array->tuples = atof(attribute(attributes, "NumberOfTuples"));
    if (*attribute(attributes, "NumberOfComponents"))
        array->components = atoi(attribute(attributes, "NumberOfComponents"));
    array->form = strcmp(format, "appended") == 0 ? ARRAY_APPENDED
                  : strcmp(format, "binary") == 0 ? ARRAY_BASE64
                                                  : ARRAY_ASCII;
    array->begin =
        (size_t)XML_GetCurrentByteIndex(xml->parser) + (size_t)XML_GetCurrentByteCount(xml->parser);
    xml->offsets |= array->form == ARRAY_APPENDED;
    if (array->form == ARRAY_APPENDED)
        array->begin = strtoull(attribute(attributes, "offset"), NULL, 10);
    xml->open = array->form != ARRAY_APPENDED;
    xml->array_count++;
}

static void end_array(Xml *xml)
{
    if (xml->open)
        xml->array[xml->array_count - 1].end = (size_t)XML_GetCurrentByteIndex(xml->parser);
    xml->open = false;
}

/* Names of parts with arrays; elements within an array are none. */
static bool is_section(const char *name)
{
    static const char *const names[] = {"FieldData", "PointData", "CellData", "Points", "Verts",
                                        "Lines",     "Strips",    "Polys",    "Cells"};
    bool is = false;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        is |= strcmp(name, names[k]) == 0;
    return is;
}

static void XMLCALL on_begin(void *user, const char *name, const char **attributes)
{
    Xml *xml = user;
    end_array(xml); /* numbers come first: a child of an array ends numbers */
    if (strcmp(name, "VTKFile") == 0)
        begin_file(xml, attributes);
    else if (strcmp(name, "Piece") == 0 && xml->head_only && !xml->offsets)
        XML_StopParser(xml->parser, XML_FALSE);
    else if (strcmp(name, "Piece") == 0)
        begin_piece(xml, attributes);
    else if (strcmp(name, "DataArray") == 0)
        begin_array(xml, attributes);
    else if (strcmp(name, "AppendedData") == 0) {
        xml->raw = strcmp(attribute(attributes, "encoding"), "raw") == 0;
        xml->appended = (size_t)XML_GetCurrentByteIndex(xml->parser);
        XML_StopParser(xml->parser, XML_FALSE); /* no XML behind */
    } else if (is_section(name))
        copy(xml->section, sizeof xml->section, name);
}

static void XMLCALL on_end(void *user, const char *name)
{
    Xml *xml = user;
    (void)name;
    end_array(xml);
}

/* Gives a document to expat. Returns false at wrong XML; a stopped parser is no failure. */
static bool run_parser(XML_Parser parser, const ForeignBytes *file, Error *error)
{
    const char *at = file->bytes, *end = at + file->size;
    enum XML_Status status = XML_STATUS_OK;
    do {
        const int some = end - at > INT_MAX / 2 ? INT_MAX / 2 : (int)(end - at);
        status = XML_Parse(parser, at, some, at + some == end);
        at += some;
    } while (status == XML_STATUS_OK && at < end);
    return status == XML_STATUS_OK || XML_GetErrorCode(parser) == XML_ERROR_ABORTED ||
           error_set(error, "%.300s:%lu: is no whole XML: %s", file->path,
                     (unsigned long)XML_GetCurrentLineNumber(parser),
                     XML_ErrorString(XML_GetErrorCode(parser)));
}

static bool read_tags(Xml *xml)
{
    const ForeignBytes *file = xml->file;
    xml->parser = XML_ParserCreate(NULL);
    if (!xml->parser)
        return error_set(xml->error, "%.300s: no memory", file->path);
    XML_SetUserData(xml->parser, xml);
    XML_SetElementHandler(xml->parser, on_begin, on_end);
    bool ok = run_parser(xml->parser, file, xml->error);
    XML_ParserFree(xml->parser);
    if (ok && xml->unable[0])
        return error_set(xml->error, "%.300s: %s", file->path, xml->unable);
    if (ok && !xml->known)
        return error_set(xml->error, "%.300s: is no file of VTK: it has no VTKFile", file->path);
    const char *mark =
        ok && xml->appended ? memchr(file->bytes + xml->appended, '_', file->size - xml->appended) : NULL;
    if (ok && xml->appended && !mark)
        return error_set(xml->error, "%.300s: its appended data have no begin", file->path);
    xml->appended = mark ? (size_t)(mark - file->bytes) + 1 : 0;
    return ok;
}

/* ---- the bytes of an array ---- */

typedef struct ByteSource {
    const unsigned char *at, *end;
    bool raw;
    unsigned char rest[3]; /* decoded, not yet taken */
    int rest_count;
} ByteSource;

static int digit_of(unsigned char c)
{
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
}

/* Decodes four letters of base64; padding may stand in the middle, where two parts are joined. */
static bool decode(ByteSource *from)
{
    unsigned bits = 0;
    int letters = 0, padding = 0;
    while (letters + padding < 4 && from->at < from->end) {
        const unsigned char c = *from->at;
        const int digit = digit_of(c);
        if (c == '<' || (digit < 0 && c != '=' && c > ' '))
            return false;
        from->at++;
        if (digit < 0 && c != '=')
            continue;
        padding += c == '=';
        letters += c != '=';
        bits = bits << 6 | (unsigned)(c == '=' ? 0 : digit);
    }
    if (letters + padding < 4 || letters < 2)
        return false;
    from->rest_count = letters - 1;
    for (int k = 0; k < 3; k++)
        from->rest[k] = (unsigned char)(bits >> (16 - 8 * k) & 255);
    return true;
}

/* Decodes groups of four letters without spaces or padding, as many as fit; most of an array. */
static size_t decode_plain(ByteSource *from, unsigned char *out, size_t size)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char digit[256];
    size_t done = 0;
    memset(digit, 64, sizeof digit);
    for (unsigned k = 0; k < 64; k++)
        digit[(unsigned char)letters[k]] = (unsigned char)k;
    for (; size - done >= 3 && from->end - from->at >= 4; done += 3, from->at += 4) {
        const unsigned char a = digit[from->at[0]], b = digit[from->at[1]], c = digit[from->at[2]],
                            d = digit[from->at[3]];
        if ((a | b | c | d) & 64)
            break;
        out[done] = (unsigned char)(a << 2 | b >> 4);
        out[done + 1] = (unsigned char)(b << 4 | c >> 2);
        out[done + 2] = (unsigned char)(c << 6 | d);
    }
    return done;
}

static bool take(ByteSource *from, void *to, size_t size)
{
    unsigned char *out = to;
    if (from->raw) {
        if ((size_t)(from->end - from->at) < size)
            return false;
        memcpy(out, from->at, size);
        from->at += size;
        return true;
    }
    while (size > 0) {
        const size_t plain = from->rest_count == 0 && size > 64 ? decode_plain(from, out, size) : 0;
        out += plain;
        size -= plain;
        if (from->rest_count == 0 && size > 0 && !decode(from))
            return false;
        const int some = size < (size_t)from->rest_count ? (int)size : from->rest_count;
        memcpy(out, from->rest, (size_t)some);
        memmove(from->rest, from->rest + some, (size_t)(from->rest_count - some));
        from->rest_count -= some;
        out += some;
        size -= (size_t)some;
    }
    return true;
}

static bool take_size(const Xml *xml, ByteSource *from, uint64_t *size)
{
    unsigned char bytes[8];
    const int count = xml->wide ? 8 : 4;
    *size = 0;
    if (!take(from, bytes, (size_t)count))
        return false;
    for (int k = 0; k < count; k++)
        *size |= (uint64_t)bytes[xml->big ? count - 1 - k : k] << 8 * k;
    return true;
}

/* Blocks of zlib: their count, bytes of a block, bytes of the last one if shorter, compressed bytes of each;
   then the blocks. */
static bool inflate_blocks(const Xml *xml, ByteSource *from, unsigned char *to, size_t size)
{
    uint64_t blocks, whole, last;
    if (!take_size(xml, from, &blocks) || !take_size(xml, from, &whole) || !take_size(xml, from, &last) ||
        blocks > xml->file->size)
        return false;
    uint64_t *packed = calloc(blocks + 1, sizeof *packed);
    unsigned char *bytes = NULL;
    size_t done = 0;
    bool ok = packed != NULL;
    for (uint64_t b = 0; ok && b < blocks; b++)
        ok = take_size(xml, from, &packed[b]) && packed[b] <= xml->file->size;
    from->rest_count = 0; /* the head is encoded alone */
    for (uint64_t b = 0; ok && b < blocks; b++) {
        uLongf room = size - done;
        unsigned char *more = realloc(bytes, packed[b] + 1);
        bytes = more ? more : bytes;
        ok = more && take(from, bytes, packed[b]) && uncompress(to + done, &room, bytes, packed[b]) == Z_OK &&
             room == (b + 1 == blocks && last > 0 ? last : whole);
        done += ok ? room : 0;
    }
    free(packed);
    free(bytes);
    return ok && done == size;
}

static ByteSource source_of(const Xml *xml, const XmlArray *array)
{
    const unsigned char *bytes = (const unsigned char *)xml->file->bytes;
    const size_t size = xml->file->size;
    if (array->form != ARRAY_APPENDED)
        return (ByteSource){.at = bytes + array->begin, .end = bytes + array->end};
    const bool there = xml->appended > 0 && array->begin <= size - xml->appended;
    return (ByteSource){.at = there ? bytes + xml->appended + array->begin : bytes,
                        .end = there ? bytes + size : bytes,
                        .raw = xml->raw};
}

static bool take_all(const Xml *xml, const XmlArray *array, unsigned char *to, size_t size)
{
    ByteSource from = source_of(xml, array);
    uint64_t said;
    if (xml->zlib)
        return inflate_blocks(xml, &from, to, size);
    return take_size(xml, &from, &said) && said == size && take(&from, to, size);
}

static int type_of(const char *name)
{
    static const char *const names[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                        "UInt32", "Int64", "UInt64", "Float32", "Float64"};
    for (int k = 0; k < FOREIGN_TYPES; k++)
        if (strcmp(name, names[k]) == 0)
            return k;
    return -1;
}

static bool damaged(const Xml *xml, const XmlArray *array)
{
    return error_set(xml->error,
                     "%.300s: the array '%s' is cut, or has another length or type than its tag says",
                     xml->file->path, array->name);
}

/* Reads `count` numbers. */
static bool read_numbers(const Xml *xml, const XmlArray *array, size_t count, double *to)
{
    const int type = type_of(array->type);
    if (type < 0)
        return damaged(xml, array);
    if (array->form == ARRAY_ASCII) {
        const char *at = xml->file->bytes + array->begin, *end = xml->file->bytes + array->end;
        for (size_t i = 0; i < count; i++) {
            while (at < end && (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r'))
                at++;
            if (!foreign_number(&at, end, &to[i]))
                return damaged(xml, array);
        }
        return true;
    }
    const size_t size = count * foreign_type_bytes((ForeignType)type);
    unsigned char *bytes = malloc(size + 1);
    const bool taken = bytes && (count == 0 || take_all(xml, array, bytes, size));
    if (taken)
        foreign_convert(bytes, (ForeignType)type, xml->big, count, to);
    free(bytes);
    return taken || damaged(xml, array);
}

/* ---- the points ---- */

static void read_time(const Xml *xml, ForeignTable *table)
{
    static const char *const names[] = {"TimeValue", "TIME", "Time", "time"};
    Error none;
    Xml quiet = *xml;
    quiet.error = &none;
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        for (int k = 0; k < xml->array_count; k++) {
            double time = NAN;
            if (xml->array[k].piece < 0 && strcmp(xml->array[k].name, names[n]) == 0 &&
                read_numbers(&quiet, &xml->array[k], 1, &time) && isfinite(time)) {
                table->time = time;
                return;
            }
        }
}

/* Adds the columns of the first piece with points, for all pieces. */
static bool read_columns(Xml *xml, ForeignTable *table)
{
    int first = 0;
    while (first + 1 < xml->pieces && xml->count[first] == 0)
        first++;
    for (int k = 0; k < xml->array_count; k++) {
        const XmlArray *array = &xml->array[k];
        if (array->piece != first || array->components < 1 || array->components > 9)
            continue;
        ForeignColumn *column =
            foreign_column_add(table, xml->file->path, array->name, array->components, xml->error);
        if (!column)
            return false;
        size_t at = 0;
        for (int piece = 0; column->value && piece < xml->pieces; at += xml->count[piece++]) {
            const XmlArray *part = NULL;
            for (int p = 0; p < xml->array_count && !part; p++)
                if (xml->array[p].piece == piece && strcmp(xml->array[p].name, array->name) == 0 &&
                    xml->array[p].components == array->components)
                    part = &xml->array[p];
            if (xml->count[piece] > 0 && !part)
                return damaged(xml, array);
            if (xml->count[piece] > 0 &&
                !read_numbers(xml, part, xml->count[piece] * (size_t)array->components,
                              column->value + at * (size_t)array->components))
                return false;
        }
    }
    return true;
}

static bool parse(const ForeignBytes *file, ForeignTable *table, Error *error)
{
    Xml *xml = calloc(1, sizeof *xml);
    if (!xml)
        return error_set(error, "%.300s: no memory", file->path);
    xml->file = file;
    xml->error = error;
    xml->head_only = table->head_only;
    bool ok = read_tags(xml);
    table->time = NAN;
    if (ok)
        read_time(xml, table);
    double count = 0;
    for (int k = 0; k < xml->pieces; k++)
        count += (double)xml->count[k];
    ok = ok && foreign_count_fits(file, count, error);
    table->count = (size_t)count;
    ok = ok && (table->head_only || read_columns(xml, table));
    free(xml);
    return ok;
}

static const char *const endings[] = {".vtp", ".vtu", NULL};

const ForeignFormat foreign_vtk_xml = {.name = "VTK", .endings = endings, .parse = parse};

/* ---- the index ---- */

typedef struct Pvd {
    const ForeignBytes *file;
    ForeignSeries *series;
    bool known, no_memory;
} Pvd;

/* A file beside the index, unless its path is whole. */
static bool add_dataset(Pvd *pvd, const char *name, double time)
{
    const char *path = pvd->file->path, *slash = strrchr(path, '/');
    const int folder = *name == '/' || !slash ? 0 : (int)(slash - path) + 1;
    const size_t size = (size_t)folder + strlen(name) + 1;
    char *whole = malloc(size);
    if (!whole)
        return false;
    memcpy(whole, path, (size_t)folder);
    memcpy(whole + folder, name, strlen(name) + 1);
    const bool added = foreign_series_add(pvd->series, whole, 0, time);
    free(whole);
    return added;
}

static void XMLCALL on_dataset(void *user, const char *name, const char **attributes)
{
    Pvd *pvd = user;
    pvd->known |= strcmp(name, "Collection") == 0;
    const char *file = attribute(attributes, "file"), *said = attribute(attributes, "timestep");
    char *end;
    const double time = strtod(said, &end);
    const ForeignSeries *series = pvd->series;
    if (strcmp(name, "DataSet") != 0 || !*file)
        return;
    /* several files of a time: the first has the particles, as slosh writes series */
    if (series->count > 0 && end > said && series->step[series->count - 1].time == time)
        return;
    pvd->no_memory |= !add_dataset(pvd, file, end > said ? time : NAN);
}

bool foreign_pvd_parse(const ForeignBytes *file, ForeignSeries *series, Error *error)
{
    Pvd pvd = {.file = file, .series = series};
    XML_Parser parser = XML_ParserCreate(NULL);
    if (!parser)
        return error_set(error, "%.300s: no memory", file->path);
    XML_SetUserData(parser, &pvd);
    XML_SetElementHandler(parser, on_dataset, NULL);
    const bool ok = run_parser(parser, file, error);
    XML_ParserFree(parser);
    if (ok && pvd.no_memory)
        return error_set(error, "%.300s: no memory", file->path);
    return ok && ((pvd.known && series->count > 0) ||
                  error_set(error, "%.300s: lists no files; an index of VTK has a Collection of DataSets",
                            file->path));
}
