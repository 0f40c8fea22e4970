// Writes a C++ source that holds the built page: `node embed.mjs DIST OUTPUT`, where OUTPUT is a folder.
// Every file that gets smaller is compressed here, once, and not whenever somebody asks for it.
import { createHash } from 'node:crypto';
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { extname, join, relative, resolve, sep } from 'node:path';
import { constants, gzipSync } from 'node:zlib';

const types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.ico': 'image/vnd.microsoft.icon',
  '.woff2': 'font/woff2',
  '.json': 'application/json',
  '.webmanifest': 'application/manifest+json',
};

function filesIn(folder) {
  return readdirSync(folder, { withFileTypes: true })
    .sort((one, other) => (one.name < other.name ? -1 : 1))
    .flatMap((entry) => (entry.isDirectory() ? filesIn(join(folder, entry.name)) : [join(folder, entry.name)]));
}

const [dist, output] = process.argv.slice(2).map((path) => resolve(path));
const blobs = join(output, 'blobs');
rmSync(blobs, { recursive: true, force: true });
mkdirSync(blobs, { recursive: true });

const rows = [];
const symbols = [];
for (const [index, file] of filesIn(dist).entries()) {
  const path = '/' + relative(dist, file).split(sep).join('/');
  const type = types[extname(file)];
  if (type === undefined) throw new Error(`${path}: embed.mjs knows no content type for it`);
  const plain = readFileSync(file);
  const smaller = gzipSync(plain, { level: constants.Z_BEST_COMPRESSION });
  const compressed = smaller.length < plain.length * 0.9;
  const tag = createHash('sha256').update(plain).digest('hex').slice(0, 20);
  const blob = join(blobs, `${index}`);
  writeFileSync(blob, compressed ? smaller : plain);
  const name = `flexrf_page_${index}`;
  symbols.push(`asm(".section .rodata\\n.balign 16\\n${name}:\\n.incbin \\"${blob}\\"\\n${name}_end:\\n.previous\\n");
extern const char ${name}[] asm("${name}");
extern const char ${name}_end[] asm("${name}_end");`);
  const lasting = path.startsWith('/assets/');
  rows.push(
    `    {"${path}", "${type}", "${tag}", ${compressed}, ${lasting}, {${name}, static_cast<std::size_t>(${name}_end - ${name})}},`,
  );
}
if (!rows.some((row) => row.includes('"/index.html"'))) throw new Error(`there is no index.html in ${dist}`);

writeFileSync(
  join(output, 'page_files.cpp'),
  `// Made by embed.mjs; do not edit.
#include <cstddef>

#include "web-ui/server/files.hpp"

${symbols.join('\n')}

namespace flexrf::panel {

std::span<const PageFile> page_files() noexcept {
  static const PageFile files[] = {
${rows.join('\n')}
  };
  return files;
}

}  // namespace flexrf::panel
`,
);
