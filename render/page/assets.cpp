#include "render/page/assets.h"

// The assembler copies the files into the program; the Makefile makes this object anew when one of
// them changes.
#define SEAM_EMBED(name, file)                                                           \
  asm(".pushsection .rodata\n" #name "_begin:\n.incbin \"render/page/" file "\"\n" #name \
      "_end:\n.popsection\n");                                                           \
  extern const char name##_begin[] asm(#name "_begin");                                  \
  extern const char name##_end[] asm(#name "_end");

SEAM_EMBED(seam_page_template, "page.html")
SEAM_EMBED(seam_page_style, "page.css")
SEAM_EMBED(seam_page_decode, "decode.js")
SEAM_EMBED(seam_page_model, "model.js")
SEAM_EMBED(seam_page_colours, "colours.js")
SEAM_EMBED(seam_page_state, "state.js")
SEAM_EMBED(seam_page_camera, "camera.js")
SEAM_EMBED(seam_page_shapes, "shapes.js")
SEAM_EMBED(seam_page_panel, "panel.js")
SEAM_EMBED(seam_page_strip, "strip.js")
SEAM_EMBED(seam_page_around, "around.js")
SEAM_EMBED(seam_page_table, "table.js")
SEAM_EMBED(seam_page_save, "save.js")
SEAM_EMBED(seam_page_player, "player.js")
SEAM_EMBED(seam_page_main, "main.js")
SEAM_EMBED(seam_page_gestures, "gestures.js")
SEAM_EMBED(seam_page_controls, "controls.js")
SEAM_EMBED(seam_page_tape, "tape.js")
SEAM_EMBED(seam_page_live, "live.js")
SEAM_EMBED(seam_page_drive, "drive.js")
SEAM_EMBED(seam_page_control, "control.js")
SEAM_EMBED(seam_page_hand, "hand.js")

namespace seam {

std::string PageTemplate() { return {seam_page_template_begin, seam_page_template_end}; }

std::string PageStyle() { return {seam_page_style_begin, seam_page_style_end}; }

namespace {

std::string Script(bool live) {
  std::string script;
  const auto add = [&script](const char* begin, const char* end) { script.append(begin, end); };
  add(seam_page_decode_begin, seam_page_decode_end);
  add(seam_page_model_begin, seam_page_model_end);
  add(seam_page_colours_begin, seam_page_colours_end);
  add(seam_page_state_begin, seam_page_state_end);
  add(seam_page_camera_begin, seam_page_camera_end);
  add(seam_page_shapes_begin, seam_page_shapes_end);
  add(seam_page_panel_begin, seam_page_panel_end);
  add(seam_page_strip_begin, seam_page_strip_end);
  add(seam_page_around_begin, seam_page_around_end);
  add(seam_page_table_begin, seam_page_table_end);
  add(seam_page_save_begin, seam_page_save_end);
  add(seam_page_player_begin, seam_page_player_end);
  add(seam_page_main_begin, seam_page_main_end);
  add(seam_page_gestures_begin, seam_page_gestures_end);
  if (live) {
    add(seam_page_tape_begin, seam_page_tape_end);
    add(seam_page_live_begin, seam_page_live_end);
    add(seam_page_drive_begin, seam_page_drive_end);
    add(seam_page_control_begin, seam_page_control_end);
    add(seam_page_hand_begin, seam_page_hand_end);
  }
  add(seam_page_controls_begin, seam_page_controls_end);
  return script;
}

}  // namespace

std::string PageScript() { return Script(false); }

std::string LivePageScript() { return Script(true); }

}  // namespace seam
