import { PNG } from 'pngjs'; import { readFileSync, writeFileSync } from 'node:fs';
const [a,b] = process.argv.slice(2,4).map(f=>PNG.sync.read(readFileSync(f)));
const o=new PNG({width:a.width,height:3*a.height}); const n=4*a.width*a.height;
const m=[0,0,0];
for(let i=0;i<n;i++){o.data[i]=i%4==3?255:a.data[i];o.data[n+i]=i%4==3?255:b.data[i];const d=b.data[i]-a.data[i]; if(i%4<3)m[i%4]+=d; o.data[2*n+i]=i%4==3?255:Math.max(0,Math.min(255,128+4*d));}
console.log('mean code difference', m.map(v=>v/(n/4)));
writeFileSync(process.argv[4],PNG.sync.write(o));
