/* The table of motion devices, with matching udev rule and docs/manual/devices.md. */
#include "tests/device/report_fixture.h"

#include <stdio.h>
#include <stdlib.h>

static char *file_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    return text;
}

static int count_rows(void)
{
    int count = 0;
    while (device_rows[count].name)
        count++;
    return count;
}

static void each_product_stands_once(void **state)
{
    (void)state;
    for (const DeviceRow *row = device_rows; row->name; row++) {
        assert_ptr_equal(device_row(row->vendor, row->product), row);
        for (int k = 0; k < 6; k++) { /* a frame each for the two halves */
            assert_true(abs(row->axes[k].sign) == 1 && row->axes[k].from / 3 == k / 3);
            for (int j = 0; j < k; j++)
                assert_int_not_equal(row->axes[j].from, row->axes[k].from);
        }
        const bool cap = row->family == DEVICE_SPACEMOUSE;
        assert_int_equal(is_cap(row->usb), cap);
        assert_int_equal(is_cap(row->bluetooth), cap);
        assert_non_null(row->buttons[0]);
    }
    assert_null(device_row(0x054c, 0x0268)); /* a DualShock 3 */
    assert_null(device_row(0x046d, 0xc077)); /* a mouse */
}

/* Mice, keyboards and number pads of the same makers. */
static void what_does_not_move_is_left_out(void **state)
{
    (void)state;
    static const uint16_t products[] = {0xc650, 0xc651, 0xc653, 0xc654, 0xc655, 0xc656,
                                        0xc657, 0xc658, 0xc664, 0xc665, 0xc668};
    for (size_t i = 0; i < sizeof products / sizeof *products; i++)
        assert_null(device_row(0x256f, products[i]));
}

/* KERNELS=="000[35]:054C:0CE6.*", TAG+="uaccess" for each, and for nothing else. */
static void the_udev_rule_names_them_all(void **state)
{
    (void)state;
    char *rule = file_text(SLOSH_SOURCE_DIR "/tools/70-slosh.rules");
    int lines = 0;
    for (const DeviceRow *row = device_rows; row->name; row++) {
        char line[80];
        snprintf(line, sizeof line, "\nKERNELS==\"000[35]:%04X:%04X.*\", TAG+=\"uaccess\"\n", row->vendor,
                 row->product);
        if (!strstr(rule, line))
            fail_msg("tools/70-slosh.rules lacks%s", line);
    }
    for (const char *at = rule; (at = strstr(at, "TAG+=")); at++)
        lines++;
    assert_int_equal(lines, count_rows());
    assert_non_null(strstr(rule, "SUBSYSTEM!=\"hidraw\", GOTO=\"slosh_end\"\n"));
    assert_true(strcmp("70-slosh.rules", "73-seat-late.rules") < 0);
    free(rule);
}

static void the_page_names_them_all(void **state)
{
    (void)state;
    char *page = file_text(SLOSH_SOURCE_DIR "/docs/manual/devices.md");
    for (const DeviceRow *row = device_rows; row->name; row++) {
        char id[8];
        snprintf(id, sizeof id, "%04x", row->product);
        if (!strstr(page, id))
            fail_msg("docs/manual/devices.md lacks %s, %s", id, row->name);
    }
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_product_stands_once),
        cmocka_unit_test(what_does_not_move_is_left_out),
        cmocka_unit_test(the_udev_rule_names_them_all),
        cmocka_unit_test(the_page_names_them_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
