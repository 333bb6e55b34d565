/// The MCAP export in Rerun's own viewer, in a browser without a display: it shows the bodies.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/browser/browser.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace rerun_test {

/// Opens the file of argv[2] with the browser of argv[3], and prints how many pixels of the left
/// of the viewer, where the bodies are, have a body's strong colour; the background is pale.
constexpr const char* kShow = R"js(
const fs = require('fs'), http = require('http'), path = require('path');
const viewer = require.resolve.paths('x').map((folder) => folder + '/@rerun-io/web-viewer')
                   .find(fs.existsSync);  // it is a module, which require cannot resolve
const puppeteer = require('puppeteer-core');
const page = `<body style="margin:0"><div id="v"></div><script type="module">
import {WebViewer} from '/viewer/index.js';
const size = {width: '1200px', height: '800px'};
await new WebViewer().start(location.origin + '/session.mcap', document.getElementById('v'),
                            {hide_welcome_screen: true, ...size});
</script>`;
const types = {'.js': 'text/javascript', '.wasm': 'application/wasm'};
const server = http.createServer((request, response) => {
  const name = request.url.split('?')[0];
  if (name === '/') return response.writeHead(200, {'content-type': 'text/html'}).end(page);
  let file = name === '/session.mcap' ? process.argv[2] :
      path.join(viewer, path.basename(name));
  if (!fs.existsSync(file)) file += '.js';
  if (!fs.existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, {'content-type': types[path.extname(file)] || 'application/mcap'});
  fs.createReadStream(file).pipe(response);
});
server.listen(0, '127.0.0.1', async () => {
  const browser = await puppeteer.launch({
    executablePath: process.argv[3], headless: true,
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
           '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist']});
  try {
    const tab = await browser.newPage();
    tab.on('console', (line) => {
      if (/Failed to import|panicked/.test(line.text())) console.error(line.text());
    });
    await tab.setViewport({width: 1200, height: 800});
    await tab.goto('http://127.0.0.1:' + server.address().port + '/');
    let strong = 0;
    for (let tries = 0; tries < 20 && strong < 40; ++tries) {
      await new Promise((done) => setTimeout(done, 5000));
      const url = 'data:image/png;base64,' + await tab.screenshot({
        encoding: 'base64', clip: {x: 205, y: 60, width: 340, height: 530}});
      strong = await tab.evaluate(async (source) => {
        const image = await createImageBitmap(await (await fetch(source)).blob());
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        const rgba = context.getImageData(0, 0, image.width, image.height).data;
        let count = 0;
        for (let i = 0; i < rgba.length; i += 4) {
          const colour = rgba.slice(i, i + 3);
          if (Math.max(...colour) - Math.min(...colour) > 90) ++count;
        }
        return count;
      }, url);
    }
    if (process.argv[4]) await tab.screenshot({path: process.argv[4]});
    console.log(strong);
  } finally {
    await browser.close();
    server.close();
  }
});
)js";

TEST(Rerun, ShowsTheBodiesOfAnExport) {
  Program probe({"node", "-e",
                 "require.resolve('puppeteer-core'); "
                 "process.exit(require.resolve.paths('x').some((folder) => "
                 "fs.existsSync(folder + '/@rerun-io/web-viewer')) ? 0 : 1)"});
  ASSERT_TRUE(probe.Wait(60));
  if (probe.status() != 0 || Browser::Find().empty()) {
    GTEST_SKIP() << "needs chromium, and node with npm's @rerun-io/web-viewer and puppeteer-core";
  }
  const LabWorkspace files;
  const std::string scene = (Root() / "scenes/wall.toml").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{LabProgram(), "run", scene, "--duration", "3", "--no-floor",
                                 "--impair", "4g", "-o", files / "run.lcm"},
        {BuiltProgram("seam-export"), files / "run.lcm", "--mcap", "-o", files / "a.mcap"}}) {
    Program program(words);
    ASSERT_TRUE(program.Wait(120));
    ASSERT_EQ(program.status(), 0) << program.Story();
  }
  files.Write("show.js", kShow);
  Program show({"node", files / "show.js", files / "a.mcap", Browser::Find()});
  ASSERT_TRUE(show.Wait(300));
  EXPECT_EQ(show.status(), 0) << show.Story();
  EXPECT_EQ(show.errors(), "");
  EXPECT_GE(std::atoi(show.output().c_str()), 40) << show.Story();
}

}  // namespace rerun_test
}  // namespace seam
