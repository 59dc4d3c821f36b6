/* Window code without a display: the device behind a GLFW joystick. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "app/window/window.h"

static void check_ids(const char *guid, uint16_t vendor, uint16_t product)
{
    uint16_t v = 0, p = 0;
    assert_true(window_guid_ids(guid, &v, &p));
    assert_int_equal(v, vendor);
    assert_int_equal(p, product);
}

/* From SDL's list of gamepads. */
static void guids_have_vendor_and_product(void **state)
{
    (void)state;
    check_ids("030000004c050000e60c000011810000", 0x054c, 0x0ce6); /* DualSense over USB */
    check_ids("050000004c050000cc09000000810000", 0x054c, 0x09cc); /* DualShock 4 over Bluetooth */
    check_ids("030000005e0400008e02000010010000", 0x045e, 0x028e); /* Xbox 360 */
}

static void others_have_none(void **state)
{
    (void)state;
    uint16_t v = 7, p = 7;
    static const char *const guids[] = {NULL,
                                        "",
                                        "xinput",
                                        "05000000576972656c65737320436f6e", /* "Wireless Con" */
                                        "78696e70757401000000000000000000", /* "xinput" */
                                        "030000004c050000e60c00001181000",
                                        "00000000000000000000000000000000"};
    for (size_t i = 0; i < sizeof guids / sizeof *guids; i++)
        if (window_guid_ids(guids[i], &v, &p))
            fail_msg("'%s' has %04x:%04x", guids[i], v, p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(guids_have_vendor_and_product),
        cmocka_unit_test(others_have_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
