// Judges a glTF file by the Khronos validator: any error or warning fails.
// Usage: node validate.mjs FILE.glb...
import { readFile } from 'node:fs/promises';
import { basename } from 'node:path';
import validator from 'gltf-validator';

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node validate.mjs FILE.glb...');
  process.exit(2);
}

// Arrays that only isolux reads are objects that no part of glTF uses: an information, no warning.
const TOLERATED_SEVERITY = 2;

let failed = false;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: basename(file),
    maxIssues: 0,
  });
  const { issues, info } = report;
  const bad = issues.messages.filter((message) => message.severity < TOLERATED_SEVERITY);
  if (bad.length > 0) {
    failed = true;
    console.log(JSON.stringify({ file, validatorVersion: report.validatorVersion, bad }, null, 2));
  }
  console.log(
    `${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos; ` +
      `${info.totalVertexCount} vertices, ${info.totalTriangleCount} triangles`,
  );
}
process.exit(failed ? 1 : 0);
