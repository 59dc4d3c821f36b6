/* The actions of the user in the window, in the order of their list on the screen and in `slosh help window`.
   First presses; then drags, the wheel, sticks and held keys. */
#ifndef APP_INPUT_ACTION_LIST_H
#define APP_INPUT_ACTION_LIST_H

/* clang-format off */
#define ACTIONS(X) \
    X(pause) X(step) X(step_back) X(back) X(ahead) X(newest) X(timeline) X(loop) X(reset) X(slower) X(faster) \
    X(next_scene) X(previous_scene) X(scenes) X(next_view) X(next_scalar) X(next_colormap) X(views) X(link_cameras) \
    X(screenshot) X(video) X(save_recording) X(save_scene) \
    X(fullscreen) X(panel) X(help) \
    X(camera_home) X(box_home) X(neutral) X(box_walls) X(box_smaller) X(box_larger) X(gravity_home) \
    X(touch) X(touch_way) X(touch_fluid) \
    X(put_ball) X(put_box) X(put_fixed_ball) X(put_fixed_box) X(put_like) X(take_solid) \
    X(plane_back) X(plane_forward) X(plane_left) X(plane_right) X(plane_up) X(plane_down) X(plane_x) X(plane_y) X(plane_z) \
    X(pin) X(unpin) X(trail) \
    X(close) X(quit) \
    X(orbit) X(pan) X(pick) X(zoom) X(move_box) X(turn_box) X(tilt_gravity) X(drag_wall) X(stir) X(pull) X(touch_size) \
    X(touch_strength) X(push_box) X(tilt_box) X(sway_box) X(lean_box) X(touch_pad)
/* clang-format on */

#endif
