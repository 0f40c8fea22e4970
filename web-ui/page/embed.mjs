// Packs the built page for page_files.cpp: `node embed.mjs DIST OUTPUT` writes page.data and page_rows.inc to the folder OUTPUT.
// Every file that gets smaller is compressed here, once, and not at each request.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { extname, join, relative, resolve, sep } from 'node:path';

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

const rows = [];
const contents = [];
let offset = 0;
for (const file of filesIn(dist)) {
  const path = '/' + relative(dist, file).split(sep).join('/');
  const type = types[extname(file)];
  if (type === undefined) throw new Error(`${path}: embed.mjs knows no content type for it`);
  const plain = readFileSync(file);
  // Not with Node's zlib, whose output differs between versions of Node: the same sources have to give the same bytes.
  const smaller = execFileSync('gzip', ['-9', '-n', '-c'], { input: plain, maxBuffer: 2 * plain.length + 1024 });
  const compressed = smaller.length < plain.length * 0.9;
  const content = compressed ? smaller : plain;
  const tag = createHash('sha256').update(plain).digest('hex').slice(0, 20);
  const lasting = path.startsWith('/assets/');
  rows.push(`{"${path}", "${type}", "${tag}", ${compressed}, ${lasting}, {flexrf_page + ${offset}, ${content.length}}},\n`);
  contents.push(content);
  offset += content.length;
}
if (!rows.some((row) => row.includes('"/index.html"'))) throw new Error(`there is no index.html in ${dist}`);

writeFileSync(join(output, 'page.data'), Buffer.concat(contents));
writeFileSync(join(output, 'page_rows.inc'), rows.join(''));
